// Dry joints that rub right after an impact by Poisson's or the energetic law, beside contacts that the impact opens,
// presses or leaves alone.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

constexpr double round_off = 1e-11;  // as spring_impacts.cpp
const char* const laws[] = {"poisson", "energetic"};

// --- a rocker on a dry pin, its left end loaded onto a stop; a ball strikes it on the right and lifts that end

TEST(ARockerOnADryPin, IsLiftedOffItsStopByTheBlowLessTheFrictionOfItsPin) {
  const double J = 1, m = 1, L = 1, r = 0.1, mu = 0.5, e = 0.5, v = 2;
  for (const char* law : laws) {
    const Finished run =
        run_text(fmt::format(R"({{
      "trammel": 1, "gravity": [0, 0],
      "bodies": {{"rocker": {{"type": "rigid_body", "mass": 3, "inertia": {J}, "markers": {{"left": [-1, 0]}}}},
                  "ball": {{"type": "point_mass", "mass": {m}, "position": [{L}, 0.02], "velocity": [0, -{v}]}}}},
      "joints": {{"pin": {{"type": "revolute", "between": ["ground", "rocker.com"], "radius": {r},
                           "friction": {{"type": "coulomb", "static": {mu}, "kinetic": {mu}}}}}}},
      "forces": {{"weight": {{"type": "load", "on": "rocker.left", "force": {{"y": -20}}}}}},
      "contacts": {{
        "stop": {{"type": "constraint_method", "between": ["rocker.left", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
        "hit": {{"type": "constraint_method", "restitution": {e}, "impact_law": "{law}",
                 "between": ["ball.point", {{"plane": {{"on": "rocker.com", "point": [0, 0], "normal": [0, 1]}}}}]}}}},
      "integrator": {{"type": "dop853", "step": 1e-3}}, "simulate": {{"until": 0.02}},
      "record": {{"every": 0.01, "observe": {{"omega": "rocker.angular_velocity"}}}}
    }})",
                             fmt::arg("J", J), fmt::arg("m", m), fmt::arg("L", L), fmt::arg("v", v), fmt::arg("r", r),
                             fmt::arg("mu", mu), fmt::arg("e", e), fmt::arg("law", law)));
    ASSERT_TRUE(run.done()) << run.report.reason;
    // The pin bears all of the blow P.
    const double P = (1 + e) * v / (1 / m + L * L / J), omega = P * L / J, braked = omega - mu * r * P / J;
    const std::vector<Event> blows = run.of_kind("impact");
    ASSERT_EQ(blows.size(), 2u) << law;
    EXPECT_EQ(blows[1].contact, "joints.pin");
    EXPECT_NEAR(blows[1].detail.at("impulse"), P, round_off) << law;
    EXPECT_NEAR(blows[1].detail.at("energy_lost"), J * (omega * omega - braked * braked) / 2, round_off) << law;
    EXPECT_NEAR(run.result["energy_dissipated"]["impact"]["stop"], 0, round_off) << law;
    EXPECT_NEAR(run.result["energy_supplied"]["constraints"], 0, round_off) << law;
    EXPECT_TRUE(run.result["warnings"].empty()) << law;
  }
}

// --- a block on a guide with an arm on a dry pin; a ball strikes either from below

class RandomArm {
 public:
  explicit RandomArm(std::mt19937& random) : random_(random) {}

  std::string scene(int i, bool strikes_arm, const std::string& loads, const std::string& floors) {
    const double length = between(0.3, 1.5), mu = between(0.05, 1.5);
    return fmt::format(
        R"({{
      "trammel": 1, "gravity": [0, 0],
      "bodies": {{"block": {{"type": "rigid_body", "mass": {}, "inertia": 1, "markers": {{"bottom": [-0.5, 0]}}}},
                  "arm": {{"type": "rigid_body", "mass": {}, "inertia": {}, "position": [{length}, 0],
                           "markers": {{"hinge": [-{length}, 0], "tip": [{}, 0]}}}},
                  "ball": {{"type": "point_mass", "mass": {}, "position": [{}, -0.02], "velocity": [0, 2]}}}},
      "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "block.com"], "axis": [0, 1]}},
                  "pin": {{"type": "revolute", "between": ["block.com", "arm.hinge"], "radius": {},
                           "friction": {{"type": "coulomb", "static": {mu}, "kinetic": {mu}}}}}}},
      "forces": {{{}}},
      "contacts": {{{}
        "hit": {{"type": "constraint_method", "restitution": {}, "impact_law": "{}",
                 "between": ["ball.point", {{"plane": {{"on": "{}", "point": [0, 0], "normal": [0, -1]}}}}]}}}},
      "integrator": {{"type": "dop853", "step": 1e-3}}, "simulate": {{"until": 0.0101}}, "record": {{"every": 0.0101}}
    }})",
        between(0.3, 3), between(0.3, 5), between(0.05, 1), between(-0.5, 0.5), between(0.2, 2),
        strikes_arm ? between(-0.3, 1) * length : 0.0, between(0.05, 0.6), loads, floors, between(0, 1), laws[i % 2],
        strikes_arm ? "arm.com" : "block.com", fmt::arg("length", length), fmt::arg("mu", mu));
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::mt19937& random_;
};

std::string floor_under(const char* name, const char* marker, double y = 0) {
  return fmt::format(
      R"("{}": {{"type": "constraint_method", "between": ["{}", {{"plane": {{"point": [0, {}], "normal": [0, 1]}}}}]}},)",
      name, marker, y);
}

std::string load_on(const char* name, const char* marker) {
  return fmt::format(R"("{}": {{"type": "load", "on": "{}", "force": {{"y": -1}}}})", name, marker);
}

TEST(ADryPin, TakesEnergyOnlyWhateverTheImpactOpensOrPresses) {
  std::mt19937 random(8);
  const std::string floors = floor_under("under_block", "block.bottom") + floor_under("under_tip", "arm.tip");
  const std::string loads = load_on("on_block", "block.com") + ", " + load_on("on_arm", "arm.tip");
  int rubbed = 0;
  for (int i = 0; i < 60; ++i) {
    const Finished run = run_text(RandomArm(random).scene(i, i % 3 != 0, loads, floors));
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    const nlohmann::json lost = run.result["energy_dissipated"]["impact"];
    if (lost.contains("joints.pin")) ++rubbed;
    for (const auto& [name, energy] : lost.items()) EXPECT_GE(energy, -round_off) << i << " " << name;
    // No force acts on a gap with a rate.
    EXPECT_NEAR(run.result["energy_supplied"]["constraints"], 0, round_off) << i;
    EXPECT_TRUE(run.result["warnings"].empty()) << i;
  }
  EXPECT_GT(rubbed, 40);
}

// The blow lifts the block off its floor, which acts no more.
TEST(ADryPin, RubsAlikeWhetherAFloorIsLeftBehindOrWasNeverThere) {
  std::mt19937 random(9);
  for (int i = 0; i < 30; ++i) {
    std::mt19937 same = random;
    const Finished with = run_text(
        RandomArm(random).scene(i, false, load_on("on_block", "block.com"), floor_under("floor", "block.bottom")));
    const Finished without = run_text(RandomArm(same).scene(i, false, "", ""));
    const std::vector<Event> a = with.of_kind("impact"), b = without.of_kind("impact");
    ASSERT_EQ(a.size(), 2u) << i;
    ASSERT_EQ(b.size(), 2u) << i;
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(a[k].contact, b[k].contact) << i;
      for (const char* what : {"impulse", "separation", "energy_lost"})
        EXPECT_NEAR(a[k].detail.at(what), b[k].detail.at(what), round_off) << i << " " << a[k].contact << " " << what;
    }
  }
}

}  // namespace
}  // namespace trammel::test
