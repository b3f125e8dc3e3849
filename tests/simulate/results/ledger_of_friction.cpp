// Friction in the ledger: closed to the method's error over contacts that slide, turn, open and close, whatever the
// power of friction is at the ends of steps.
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// What no cause explains [J], and all that moved.
double unexplained(const Finished& run) {
  return std::abs(run.result["energy_dissipated"]["numerical"].get<double>());
}
double moved(const Finished& run) {
  return std::abs(run.result["energy_supplied"]["total"].get<double>()) +
         run.result["energy_end"]["kinetic"].get<double>() +
         run.result["energy_dissipated"]["friction_total"].get<double>() +
         run.result["energy_dissipated"]["impact_total"].get<double>();
}
// Each step may err by the tolerance, relative to what moved, if all errors add up.
double allowed(const Finished& run, double tolerance) {
  return tolerance * run.result["counts"]["steps"].get<double>() * std::max(1.0, moved(run));
}
int count(const Finished& run, const std::string& kind) {
  return int(run.of_kind(kind).size());
}

// A slider between dead centres, driven so hard that it lifts off its plane, one edge after the other or both.
std::string slider_crank(std::mt19937& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  return fmt::format(
      R"json({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "parameters": {{"r": {}, "l": {}, "phi": {}, "beta": "=-asin(r*sin(phi)/l)"}},
    "bodies": {{
      "crank": {{"type": "rigid_body", "mass": 1, "inertia": "=r^2/12", "position": ["=r/2*cos(phi)", "=r/2*sin(phi)"],
                "angle": "=phi", "markers": {{"a": ["=-r/2", 0], "b": ["=r/2", 0]}}}},
      "rod": {{"type": "rigid_body", "mass": 0.5, "inertia": "=0.5*l^2/12", "angle": "=beta",
              "position": ["=r*cos(phi)+l/2*cos(beta)", "=r*sin(phi)+l/2*sin(beta)"],
              "markers": {{"a": ["=-l/2", 0], "b": ["=l/2", 0]}}}},
      "slider": {{"type": "rigid_body", "mass": {}, "inertia": 0.001, "position": ["=r*cos(phi)+l*cos(beta)", 0],
                 "markers": {{"left": [-0.04, -0.02], "right": [0.04, -0.02]}}}}}},
    "joints": {{"main": {{"type": "revolute", "between": ["ground", "crank.a"]}},
               "pin": {{"type": "revolute", "between": ["crank.b", "rod.a"]}},
               "wrist": {{"type": "revolute", "between": ["rod.b", "slider.com"]}}}},
    "forces": {{"motor": {{"type": "drive", "between": ["ground", "crank.a"], "stall": {}, "free_speed": {}}}}},
    "contacts": {{
      "left": {{"type": "constraint_method", "between": ["slider.left", {{"plane": {{"point": [0, -0.02], "normal": [0, 1]}}}}],
               "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}},
      "right": {{"type": "constraint_method", "between": ["slider.right", {{"plane": {{"point": [0, -0.02], "normal": [0, 1]}}}}],
                "friction": {{"type": "coulomb", "static": 0.25, "kinetic": 0.15}}}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-10}}}},
    "simulate": {{"until": 0.6}}, "record": {{"every": 0.1}}}})json",
      between(0.08, 0.12), between(0.28, 0.35), between(0.6, 1.2), between(0.6, 1), between(4, 6), between(25, 35),
      between(0.2, 0.3), between(0.1, 0.2));
}

TEST(LedgerOfFriction, ClosesOverSlidersThatLiftOffAndComeBack) {
  std::mt19937 random(28);
  int opened = 0, turned = 0;
  for (int i = 0; i < 12; ++i) {
    const std::string scene = slider_crank(random);
    const Finished run = run_text(scene);
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_LT(unexplained(run), allowed(run, 1e-10)) << scene;
    opened += count(run, "contact_open"), turned += count(run, "reversal");
  }
  EXPECT_GE(opened, 12);  // it is about these
  EXPECT_GE(turned, 12);
}

// A block that a load along the normal presses on its plane and lifts off it, as it slides.
std::string lifted_block(std::mt19937& random, double tolerance) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const double mu = between(0.1, 0.4);
  return fmt::format(
      R"json({{"trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {{"block": {{"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [{}, 0]}}}},
    "forces": {{"lift": {{"type": "load", "on": "block.point", "force": {{"x": 0, "y": "={}*sin({}*t)"}}}},
               "spring": {{"type": "spring_damper", "between": ["ground", "block.point"], "stiffness": {}, "length": 0}}}},
    "contacts": {{"floor": {{"type": "constraint_method",
                            "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                            "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": {}}}}},
    "simulate": {{"until": 2}}, "record": {{"every": 0.5}}}})json",
      between(1, 4), between(11, 16), between(10, 20), between(20, 80), mu, mu, tolerance);
}

TEST(LedgerOfFriction, ClosesOverBlocksThatAreLiftedAsTheySlide) {
  std::mt19937 random(7);
  for (const double tolerance : {1e-6, 1e-10}) {
    int opened = 0;
    for (int i = 0; i < 12; ++i) {
      const std::string scene = lifted_block(random, tolerance);
      const Finished run = run_text(scene);
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_LT(unexplained(run), allowed(run, tolerance)) << scene;
      opened += count(run, "contact_open");
    }
    EXPECT_GE(opened, 24);
  }
}

// Fixed steps of fourth order: the remainder falls with h^4, not with the h^2 of a mean multiplier.
TEST(LedgerOfFriction, IsOfTheMethodsOrderWhereAContactSlides) {
  const auto left = [](const char* step) {
    std::mt19937 random(3);
    const Finished run = run_text(
        slider_crank(random),
        {{"integrator", fmt::format(R"({{"type": "runge_kutta_4", "step": {}}})", step)}, {"simulate.until", "0.1"}});
    EXPECT_TRUE(run.done()) << run.report.reason;
    EXPECT_EQ(count(run, "contact_open") + count(run, "reversal"), 0);
    return unexplained(run);
  };
  EXPECT_GT(std::log2(left("4e-4") / left("2e-4")), 3.5);
}

// From one turn of a slip to the next in a single long step: no power at either end, all of the loss between.
TEST(LedgerOfFriction, GivesWhatASlipLosesBetweenItsTurns) {
  // 1 kg on a spring of 100 N/m from x = 1, mu N = 5 N: each half swing loses 5 N times its way, 2 (1 - (2 k + 1)
  // 0.05).
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"block": {"type": "point_mass", "mass": 1, "position": [1, 0]}},
    "forces": {"spring": {"type": "spring_damper", "between": ["ground", "block.point"], "stiffness": 100, "length": 0}},
    "contacts": {"floor": {"type": "constraint_method", "between": ["block.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
                          "friction": {"type": "coulomb", "static": 0.5, "kinetic": 0.5}}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-2, "initial": 0.5}},
    "simulate": {"until": 1.25}, "record": {"every": 1.25}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(count(run, "reversal"), 3);  // at multiples of pi/10
  const double lost = run.result["energy_dissipated"]["friction_total"];
  const double way = 2 * (0.95 + 0.85 + 0.75) + 2 * 0.65 * (1 - std::cos(10 * 1.25 - 3 * EIGEN_PI)) / 2;
  EXPECT_NEAR(lost, 5 * way, 0.02 * 5 * way);  // a tolerance of 1e-2
}

// A box between two slides whose guides rub: what the contacts share changes the loads of the guides. By trapezoids of
// the records.
TEST(LedgerOfFriction, GivesWhatJointsTakeBesideContactsThatShareForces) {
  const auto touches = [](const char* corner, const char* slide, int normal) {
    return fmt::format(R"({{"type": "constraint_method", "restitution": 0, "between": ["b.{}",
                           {{"plane": {{"point": [0, 0], "normal": [{}, 0], "on": "{}.f"}}}}],
                           "friction": {{"type": "coulomb", "static": 0.6, "kinetic": 0.6}}}})",
                       corner, normal, slide);
  };
  const auto guide = [](double x, const char* slide, double length) {
    return fmt::format(R"({{"type": "prismatic", "between": [{{"point": [{}, 0.18]}}, "{}.com"], "axis": [1, 0],
                           "length": {}, "friction": {{"type": "coulomb", "static": 0.08, "kinetic": 0.08}}}})",
                       x, slide, length);
  };
  const Finished run = run_text(fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{
    "b": {{"type": "rigid_body", "mass": 1.4, "inertia": 0.033, "position": [0, 0.18],
          "markers": {{"l": [-0.2, -0.18], "tl": [-0.2, 0.18], "r": [0.2, -0.18], "tr": [0.2, 0.18], "hand": [0.02, 0.18]}}}},
    "d": {{"type": "rigid_body", "mass": 0.5, "inertia": 0.05, "position": [-0.2, 0.18],
          "markers": {{"f": [0, 0], "k": [0.02, 0.14]}}}},
    "e": {{"type": "rigid_body", "mass": 1.3, "inertia": 0.13, "position": [0.2, 0.18],
          "markers": {{"f": [0, 0], "k": [0.13, -0.18]}}}}}},
  "joints": {{"gd": {}, "ge": {}}},
  "contacts": {{"pl": {}, "ptl": {}, "qr": {}, "qtr": {}}},
  "forces": {{"k": {{"type": "load", "on": "d.k", "force": {{"x": 51}}}},
             "k2": {{"type": "load", "on": "e.k", "force": {{"x": "=-51+19.5*t"}}}},
             "h": {{"type": "load", "on": "b.hand", "force": {{"x": "=-6.1*t", "y": "=-23.2*t"}}}}}},
  "simulate": {{"until": 1.1}},
  "record": {{"every": 0.005, "observe": {{"gd": "joints.gd.friction", "ge": "joints.ge.friction",
                                         "v_d": "joints.gd.slip", "v_e": "joints.ge.slip"}}}}}})",
      guide(-0.2, "d", 0.18), guide(0.2, "e", 0.22), touches("l", "d", 1), touches("tl", "d", 1), touches("r", "e", -1),
      touches("tr", "e", -1)));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto& t = run.series.at("t");
  const auto power = [&](std::size_t i) {
    return std::abs(run.series.at("gd")[i] * run.series.at("v_d")[i]) +
           std::abs(run.series.at("ge")[i] * run.series.at("v_e")[i]);
  };
  double taken = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    taken += (power(i - 1) + power(i)) / 2 * (t[i] - t[i - 1]);
    EXPECT_NEAR(run.series.at("energy_dissipated")[i], taken, 2e-4) << t[i];
  }
  EXPECT_GT(taken, 0.1);
}

}  // namespace
}  // namespace trammel::test
