// Smooth friction in impacts of rigid contacts: Coulomb's law far above its own speed, the limit of a stiff compliant
// contact.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/between.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

constexpr double round_off = 1e-10;  // as spring_impacts.cpp, of rates up to 10 m/s
const char* const laws[] = {"newton", "poisson", "energetic"};

std::string smooth(double mu, double v_c = 1e-3) {
  return fmt::format(R"({{"type": "regularized_coulomb", "coefficient": {:.17g}, "critical_velocity": {:.17g}}})", mu,
                     v_c);
}

std::string coulomb(double mu) {
  return fmt::format(R"({{"type": "coulomb", "static": {0:.17g}, "kinetic": {0:.17g}}})", mu);
}

std::string rigid(const char* law, double e) {
  return fmt::format(R"("type": "constraint_method", "impact_law": "{}", "restitution": {:.17g})", law, e);
}

// --- a rod of 1 kg that lands on its tip

struct Landing {
  double angle, inertia, slip, omega, mu, e;

  static Landing any(std::mt19937& random) {
    const auto from = [&](double low, double high) { return between(random, low, high); };
    Landing l{from(-1.2, 1.2), from(0.02, 0.2), from(-2, 2), from(-1, 1), from(0.1, 1.5), from(0, 1)};
    if (random() % 3 == 0) l.slip = 0;  // the impact makes it
    return l;
  }
  std::string scene(const std::string& contact, const std::string& friction) const {
    const double x = 0.5 * std::sin(angle), y = -0.5 * std::cos(angle);  // of the tip, from the centre
    return fmt::format(
        R"({{
      "trammel": 1, "gravity": [0, 0],
      "bodies": {{"rod": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "angle": {:.17g}, "position": [0, {:.17g}],
                           "velocity": [{:.17g}, {:.17g}], "angular_velocity": {:.17g}, "markers": {{"tip": [0, -0.5]}}}}}},
      "contacts": {{"tip": {{{}, "friction": {}, "between": ["rod.tip", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
      "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-9}}}},
      "simulate": {{"until": 2e-3}},
      "record": {{"every": 2e-3, "observe": {{"vx": "rod.com.vx", "vy": "rod.com.vy", "omega": "rod.angular_velocity"}}}}
    }})",
        inertia, angle, -y + 1e-9, slip + omega * y, -1 - omega * x, omega, contact, friction);
  }
};

double difference(const Finished& a, const Finished& b) {
  double most = 0;
  for (const char* rate : {"vx", "vy", "omega"}) most = std::max(most, std::abs(a.end(rate) - b.end(rate)));
  return most;
}

TEST(SmoothFrictionInAnImpact, IsCoulombsFarAboveItsSpeed) {
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    const Landing l = Landing::any(random);
    // Not 0: the laws differ on a tip that stays.
    const std::string contact = rigid(laws[i % 3], std::max(l.e, 0.05));
    const Finished one = run_text(l.scene(contact, smooth(l.mu))), other = run_text(l.scene(contact, coulomb(l.mu)));
    ASSERT_TRUE(one.done() && other.done()) << i << ": " << one.report.reason << other.report.reason;
    EXPECT_LE(difference(one, other), round_off) << i;
  }
}

// Without damping the impact is that of the energetic law with e = 1. What is left is of the size of v_c, by which the
// law creeps where Coulomb's would stick.
TEST(SmoothFrictionInAnImpact, IsThatOfAStiffCompliantContact) {
  std::mt19937 random(12);
  for (int i = 0; i < 24; ++i) {
    const Landing l = Landing::any(random);
    for (const double v_c : {3e-2, 1e-2, 3e-3}) {
      const std::string friction = smooth(l.mu, v_c);
      const Finished stiff =
          run_text(l.scene(R"("type": "continuous_force", "stiffness": 1e13, "damping": "none")", friction));
      const Finished impact = run_text(l.scene(rigid("energetic", 1), friction));
      ASSERT_TRUE(stiff.done() && impact.done()) << i << ": " << stiff.report.reason << impact.report.reason;
      EXPECT_LE(difference(impact, stiff), 3 * v_c) << i;
    }
  }
}

TEST(SmoothFrictionInAnImpact, CreatesNoEnergyWithoutRestitution) {
  std::mt19937 random(13);
  for (int i = 0; i < 60; ++i) {
    Landing l = Landing::any(random);
    l.mu *= 2;
    const Finished run = run_text(l.scene(rigid(laws[i % 3], 0), smooth(l.mu, between(random, 1e-4, 1))));
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << i;
    EXPECT_GE(run.of_kind("impact").at(0).detail.at("energy_lost"), 0) << i;
    EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9) << i;  // of the steps
  }
}

// --- a point mass that lands on a floor in space

TEST(SmoothFrictionInAnImpact, StopsTheSlipOfAPointMassAndNeverReversesIt) {
  std::mt19937 random(14);
  for (int i = 0; i < 60; ++i) {
    const double mu = between(random, 0.1, 1), e = between(random, 0.1, 1), speed = between(random, 0.01, 2),
                 direction = between(random, 0, 6.28);
    const Finished run = run_text(fmt::format(
        R"({{
      "trammel": 1, "space": "spatial",
      "bodies": {{"p": {{"type": "point_mass", "mass": 0.7, "position": [0, 0, 1e-3], "velocity": [{:.17g}, {:.17g}, -1]}}}},
      "contacts": {{"floor": {{{}, "friction": {}, "between": ["p.point", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]}}}}]}}}},
      "integrator": {{"type": "dop853", "step": 1e-3}}, "simulate": {{"until": 2e-3}},
      "record": {{"every": 2e-3, "observe": {{"vx": "p.point.vx", "vy": "p.point.vy"}}}}
    }})",
        speed * std::cos(direction), speed * std::sin(direction), rigid(laws[i % 3], e), smooth(mu)));
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    const double after = std::max(0.0, speed - mu * (1 + e)), kept = after * after - speed * speed;
    EXPECT_NEAR(run.end("vx"), after * std::cos(direction), round_off) << i;
    EXPECT_NEAR(run.end("vy"), after * std::sin(direction), round_off) << i;
    EXPECT_NEAR(run.result["energy_dissipated"]["impact"]["floor"], 0.35 * (1 - e * e - kept), round_off) << i;
  }
}

// --- contacts that the impact of others loads, and joints that rub beside them: all of them alike with either law

void expect_same_impacts(const Finished& one, const Finished& other, int i) {
  ASSERT_TRUE(one.done() && other.done()) << i << ": " << one.report.reason << other.report.reason;
  const std::vector<Event> a = one.of_kind("impact"), b = other.of_kind("impact");
  ASSERT_EQ(a.size(), b.size()) << i;
  EXPECT_FALSE(a.empty()) << i;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].contact, b[k].contact) << i;
    for (const char* what : {"impulse", "separation", "energy_lost", "friction"})
      EXPECT_NEAR(a[k].detail.at(what), b[k].detail.at(what), round_off) << i << " " << a[k].contact << " " << what;
  }
}

// A ball strikes the slanted face of a block that rests on the floor without slip.
TEST(SmoothFrictionInAnImpact, ActsOnSlipThatAnotherContactMakes) {
  std::mt19937 random(15);
  for (int i = 0; i < 30; ++i) {
    const double mu = between(random, 0.05, 1.2), slant = between(random, 0.2, 1.3), e = between(random, 0, 1),
                 mass = between(random, 0.3, 3);
    const auto run = [&](const std::string& friction) {
      const auto foot = [&](const char* name) {
        return fmt::format(
            R"("{0}": {{"type": "constraint_method", "friction": {1}, "between": ["block.{0}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
            name, friction);
      };
      return run_text(fmt::format(
          R"({{
        "trammel": 1, "gravity": [0, -10],
        "bodies": {{"block": {{"type": "rigid_body", "mass": {:.17g}, "inertia": 0.1, "position": [0, 0.2],
                               "markers": {{"left": [-0.4, -0.2], "right": [0.4, -0.2], "face": [-0.1, 0.1]}}}},
                    "ball": {{"type": "point_mass", "mass": 0.5, "position": [-0.13, 0.3], "velocity": [3, 0]}}}},
        "contacts": {{{}, {}, "hit": {{{}, "between": ["ball.point", {{"plane": {{"on": "block.face", "point": [0, 0], "normal": [{:.17g}, {:.17g}]}}}}]}}}},
        "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-12}}}}, "simulate": {{"until": 0.0101}}, "record": {{"every": 0.0101}}
      }})",
          mass, foot("left"), foot("right"), rigid(laws[i % 3], e), -std::cos(slant), std::sin(slant)));
    };
    expect_same_impacts(run(smooth(mu)), run(coulomb(mu)), i);
  }
}

// An arm on a dry pin falls on its tip.
TEST(SmoothFrictionInAnImpact, LoadsADryJointAsCoulombsDoes) {
  std::mt19937 random(16);
  for (int i = 0; i < 30; ++i) {
    const double mu = between(random, 0.05, 0.6), slant = between(random, 0.2, 1.3), e = between(random, 0.1, 1),
                 inertia = between(random, 0.02, 0.3), radius = between(random, 0.02, 0.3),
                 pin = between(random, 0.05, 0.8), omega = between(random, 1, 3);
    const auto run = [&](const std::string& friction) {
      return run_text(fmt::format(
          R"({{
        "trammel": 1, "gravity": [0, 0],
        "bodies": {{"arm": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "angle": {:.17g}, "angular_velocity": {:.17g},
                             "position": [{:.17g}, {:.17g}], "velocity": [{:.17g}, {:.17g}],
                             "markers": {{"hinge": [-0.5, 0], "tip": [0.5, 0]}}}}}},
        "joints": {{"pin": {{"type": "revolute", "between": ["ground", "arm.hinge"], "radius": {:.17g}, "friction": {}}}}},
        "contacts": {{"tip": {{{}, "friction": {}, "between": ["arm.tip", {{"plane": {{"point": [0, {:.17g}], "normal": [0, 1]}}}}]}}}},
        "integrator": {{"type": "dop853", "step": 1e-3}}, "simulate": {{"until": 2e-3}}, "record": {{"every": 2e-3}}
      }})",
          inertia, -slant, -omega, 0.5 * std::cos(slant), -0.5 * std::sin(slant), -0.5 * omega * std::sin(slant),
          -0.5 * omega * std::cos(slant), radius, coulomb(pin), rigid(laws[i % 3], e), friction,
          -std::sin(slant) - 1e-3 * omega * std::cos(slant)));
    };
    expect_same_impacts(run(smooth(mu)), run(coulomb(mu)), i);
  }
}

}  // namespace
}  // namespace trammel::test
