// Friction in joints whose rows, or whose contacts' rows, follow from others: dead centres of a slider-crank, and loads
// that depend on how contacts share forces.
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

constexpr double g = 9.81;  // [m/s^2]

std::string coulomb(double mu_0, double mu) {
  return fmt::format(R"({{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}})", mu_0, mu);
}
std::string coulomb(double mu) {
  return coulomb(mu, mu);
}

// --- a slider-crank driven at constant speed, whose slider rubs on its guide

// At a dead centre the slip of the guide reverses, and its row follows from those of the other joints: no friction can
// hold it there. x = r cos phi + sqrt(L^2 - r^2 sin^2 phi).
TEST(SliderCrank, RubsOnItsGuideThroughItsDeadCentres) {
  constexpr double r = 0.2, L = 0.5, phi_0 = 0.5, omega = 14, until = 1;
  const double s = r * std::sin(phi_0), c = r * std::cos(phi_0), psi = -std::asin(s / L), along = L * std::cos(psi);
  const double psi_t = -omega * c / along;  // L sin(psi) = -r sin(phi)
  const Finished run = run_text(fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81], "bodies": {{
             "crank": {{"type": "rigid_body", "mass": 1, "inertia": 0.003, "position": [{}, {}], "angle": {},
                        "velocity": [{}, {}], "angular_velocity": {}, "markers": {{"o": [-0.1, 0], "p": [0.1, 0]}}}},
             "rod": {{"type": "rigid_body", "mass": 0.5, "inertia": 0.01, "position": [{}, {}], "angle": {},
                      "velocity": [{}, {}], "angular_velocity": {}, "markers": {{"a": [-0.25, 0], "b": [0.25, 0]}}}},
             "slider": {{"type": "rigid_body", "mass": 1, "inertia": 0.001, "position": [{}, 0],
                 "velocity": [{}, 0]}}}},
           "joints": {{"o": {{"type": "revolute", "between": ["ground", "crank.o"], "angle": "={}+{}*t"}},
                       "p": {{"type": "revolute", "between": ["crank.p", "rod.a"]}},
                       "q": {{"type": "revolute", "between": ["rod.b", "slider.com"]}},
                       "guide": {{"type": "prismatic", "between": ["ground", "slider.com"], "length": 0.1,
                                  "friction": {}}}}},
           "simulate": {{"until": {}}},
           "record": {{"every": 0.1, "observe": {{"x": "slider.com.x", "T": "joints.guide.friction"}}}}}})",
      c / 2, s / 2, phi_0, -omega * s / 2, omega * c / 2, omega, c + along / 2, s / 2, psi,
      -omega * s + L / 2 * std::sin(-psi) * psi_t, omega * c / 2, psi_t, c + along,
      -omega * s + L * std::sin(-psi) * psi_t, phi_0, omega, coulomb(0.2), until));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
  const double phi = phi_0 + omega * until;
  EXPECT_NEAR(run.end("x"), r * std::cos(phi) + std::sqrt(L * L - std::pow(r * std::sin(phi), 2)), 1e-9);
  const double lost = run.result["energy_dissipated"]["joint_friction"]["guide"].get<double>();
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-6 * lost);
}

// Nothing drives it: at its dead centres it goes on by its inertia, and all that it loses is lost to friction.
TEST(SliderCrank, SwingsThroughItsDeadCentresByItself) {
  for (const double mu : {0.05, 0.3, 1.0}) {
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, 0], "bodies": {{
               "crank": {{"type": "rigid_body", "mass": 1, "inertia": 0.01, "position": [0, 0.1], "angle": {0},
                          "velocity": [-0.5, 0], "angular_velocity": 5, "markers": {{"o": [-0.1, 0], "p": [0.1, 0]}}}},
               "rod": {{"type": "rigid_body", "mass": 0.2, "inertia": 0.001, "position": [{1}, 0.1], "angle": {2},
                        "velocity": [-1, 0], "markers": {{"a": [-0.25, 0], "b": [0.25, 0]}}}},
               "slider": {{"type": "rigid_body", "mass": 0.2, "inertia": 1e-4, "position": [{3}, 0],
                           "velocity": [-1, 0]}}}},
             "joints": {{"o": {{"type": "revolute", "between": ["ground", "crank.o"]}},
                         "p": {{"type": "revolute", "between": ["crank.p", "rod.a"]}},
                         "q": {{"type": "revolute", "between": ["rod.b", "slider.com"]}},
                         "guide": {{"type": "prismatic", "between": ["ground", "slider.com"], "length": 0.1,
                                    "friction": {4}}}}},
             "simulate": {{"until": 0.6}},
             "record": {{"every": 0.01, "observe": {{"T": "joints.guide.friction", "N": "joints.guide.load"}}}}}})",
        pi / 2, std::sqrt(0.21) / 2, -std::asin(0.4), std::sqrt(0.21), coulomb(mu)));
    ASSERT_TRUE(run.done()) << mu << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
    EXPECT_FALSE(run.of_kind("reversal").empty()) << mu;  // at the first of them
    for (std::size_t k = 0; k < run.series.at("T").size(); ++k)
      EXPECT_LE(std::abs(run.series.at("T")[k]), mu * run.series.at("N")[k] + 1e-9) << mu << ": " << k;
    const double lost = run.result["energy_dissipated"]["joint_friction"]["guide"].get<double>();
    EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-6 * lost) << mu;
  }
}

// All four joints rub, and nothing drives it but its weight. At its last dead centre the slips of all end within
// 1e-9 s, where their rows nearly depend on each other.
TEST(SliderCrank, ComesToRestWithFrictionInAllItsJoints) {
  const double crank = 0.2, rod = 0.5, angle = 2.28;
  const double x = crank * std::cos(angle), y = crank * std::sin(angle), turn = -std::asin(y / rod);
  const double along = rod * std::cos(turn);
  for (const double omega : {9.1, 10.4, 11.7, 13.0, 14.3, 15.6})
    for (const double mu : {0.2, 0.3, 0.4}) {
      const double of_rod = -omega * x / along, u = -omega * y - rod * std::sin(turn) * of_rod;
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81], "bodies": {{
                 "crank": {{"type": "rigid_body", "mass": 1, "inertia": 0.0033, "position": [{0:.17g}, {1:.17g}],
                            "angle": {2}, "velocity": [{3:.17g}, {4:.17g}], "angular_velocity": {5},
                            "markers": {{"o": [-0.1, 0], "p": [0.1, 0]}}}},
                 "rod": {{"type": "rigid_body", "mass": 0.5, "inertia": 0.0104, "position": [{6:.17g}, {1:.17g}],
                          "angle": {7:.17g}, "velocity": [{8:.17g}, {4:.17g}], "angular_velocity": {9:.17g},
                          "markers": {{"a": [-0.25, 0], "b": [0.25, 0]}}}},
                 "slider": {{"type": "rigid_body", "mass": 1, "inertia": 1e-3, "position": [{10:.17g}, 0],
                             "velocity": [{11:.17g}, 0]}}}},
               "joints": {{"o": {{"type": "revolute", "between": ["ground", "crank.o"], "radius": 0.02,
                                  "friction": {12}}},
                           "p": {{"type": "revolute", "between": ["crank.p", "rod.a"], "radius": 0.015,
                                  "friction": {12}}},
                           "q": {{"type": "revolute", "between": ["rod.b", "slider.com"], "radius": 0.01,
                                  "friction": {12}}},
                           "guide": {{"type": "prismatic", "between": ["ground", "slider.com"], "length": 0.1,
                                      "friction": {12}}}}},
               "simulate": {{"until": 3}},
               "record": {{"every": 0.5, "observe": {{"omega": "crank.angular_velocity"}}}}}})",
          x / 2, y / 2, angle, -omega * y / 2, omega * x / 2, omega, x + along / 2, turn, (u - omega * y) / 2, of_rod,
          x + along, u, coulomb(mu)));
      ASSERT_TRUE(run.done()) << omega << ", " << mu << ": " << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
      EXPECT_NEAR(run.end("omega"), 0, 1e-9) << omega << ", " << mu;
    }
}

// --- a cart on three wheels whose hubs rub: the forces at the floor, and with them the loads, are indeterminate

struct Cart {
  double mass = 30, wheel_mass = 1, wheel_inertia = 0.005, R = 0.1, hub = 0.02, mu = 0.2, base = 0.5, F = 0;
};

std::string cart(const Cart& c, const std::array<const char*, 3>& names) {
  std::string bodies, joints, contacts, recorded = R"("x": "body.com.x")";
  const auto add = [](std::string& all, const std::string& text) { all += (all.empty() ? "" : ", ") + text; };
  for (int i = 0; i < 3; ++i) {
    const std::string w = names[std::size_t(i)];
    add(recorded, fmt::format(R"("reaction{0}": "joints.hub{0}.reaction")", i));
    if (c.mu > 0) add(recorded, fmt::format(R"("load{0}": "joints.hub{0}.load")", i));
    add(bodies, fmt::format(R"("{}": {{"type": "rigid_body", "mass": {}, "inertia": {}, "position": [{}, {}]}})", w,
                            c.wheel_mass, c.wheel_inertia, (i - 1) * c.base, c.R));
    const std::string rubs = c.mu > 0 ? fmt::format(R"(, "radius": {}, "friction": {})", c.hub, coulomb(c.mu)) : "";
    add(joints, fmt::format(R"("hub{}": {{"type": "revolute", "between": ["body.h{}", "{}.com"]{}}})", i, i, w, rubs));
    add(contacts, fmt::format(R"("{}": {{"type": "constraint_method", "radius": {}, "friction": {},
                                          "between": ["{}.com", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                              w, c.R, coulomb(0.6), w));
  }
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
           "bodies": {{"body": {{"type": "rigid_body", "mass": {}, "inertia": 5, "position": [0, {}],
                                 "markers": {{"h0": [{}, 0], "h1": [0, 0], "h2": [{}, 0]}}}}, {}}},
           "joints": {{{}}}, "contacts": {{{}}},
           "forces": {{"push": {{"type": "load", "on": "body.com", "force": {{"x": {}}}}}}},
           "integrator": {}, "simulate": {{"until": 0.5}},
           "record": {{"every": 0.1, "observe": {{{}}}}}}})",
      c.mass, c.R, -c.base, c.base, bodies, joints, contacts, c.F,
      R"({"type": "dop853", "step": {"tolerance": 1e-12}})", recorded);
}

// The wheels share the weight like equal springs, whatever their names are. Friction in the hubs, mu r N, turns the
// body, so the wheels in front carry more. Loads and acceleration follow from each other in a few rounds. The reaction
// of a hub is its load, also of one that does not rub.
TEST(CartOnRubbingHubs, RollsUnderTheLoadsThatItsWheelsShare) {
  for (const auto& [mu, F] : {std::pair{0.2, 0.0}, {0.2, 60.0}, {0.0, 60.0}})
    for (const auto& names : {std::array{"a", "b", "c"}, {"b", "c", "a"}, {"c", "a", "b"}, {"c", "b", "a"}}) {
      const Cart c{.mu = mu, .F = F};
      const Finished run = run_text(cart(c, names));
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
      std::array<double, 3> N = {c.mass * g / 3, c.mass * g / 3, c.mass * g / 3};
      double a = 0;
      for (int round = 0; F > 0 && round < 100; ++round) {
        const double all = N[0] + N[1] + N[2], rolls = c.wheel_mass + c.wheel_inertia / (c.R * c.R);
        a = (F - c.mu * c.hub / c.R * all) / (c.mass + 3 * rolls);
        for (int i = 0; i < 3; ++i) {
          const double up = c.mass * g / 3 + (i - 1) * c.mu * c.hub * all / (2 * c.base);
          const double along = rolls * a + c.mu * c.hub / c.R * N[std::size_t(i)];
          N[std::size_t(i)] = std::hypot(up, along);
        }
      }
      EXPECT_NEAR(run.end("x"), a * 0.25 / 2, 1e-9) << names[0];
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(run.end(fmt::format("reaction{}", i)), N[std::size_t(i)], 1e-7) << names[0];
        if (mu > 0) {
          EXPECT_NEAR(run.end(fmt::format("load{}", i)), N[std::size_t(i)], 1e-7) << names[0];
        }
      }
    }
}

// --- a drawer that a load pushes against two stops and then pulls off them

struct StoppedDrawer {
  double L = 0.59, mu_0 = 0.8, x = 0.295, y = 0.24;  // the load, 15 sin(7 t) and 7 t [N], acts at x, y
  double pull(double t) const { return 15 * std::sin(7 * t); }
  double held(double t) const { return mu_0 * 2 * std::abs(x * 7 * t - y * pull(t)) / L; }
};

std::string stopped(const StoppedDrawer& d, const char* bottom, const char* top) {
  const auto stop = [](const char* name, const char* marker) {
    return fmt::format(R"("{}": {{"type": "constraint_method", "restitution": 0, "friction": {},
                                  "between": ["drawer.{}", {{"plane": {{"point": [0.345, 0], "normal": [-1, 0]}}}}]}})",
                       name, coulomb(0.3), marker);
  };
  return fmt::format(R"({{
    "trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {{"drawer": {{"type": "rigid_body", "mass": 7.5, "inertia": 0.24, "position": [0, 0], "markers": {{
                            "bottom": [{0}, -0.1], "top": [{0}, 0.1], "knob": [{0}, {1}]}}}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "drawer.com"], "length": {2}, "friction": {3}}}}},
    "forces": {{"pull": {{"type": "load", "on": "drawer.knob", "force": {{"x": "{4}", "y": "=7*t"}}}}}},
    "contacts": {{{5}, {6}}}, "simulate": {{"until": 0.6}},
    "record": {{"every": 0.01, "observe": {{"x": "drawer.com.x"}}}}
  }})",
                     d.x, d.y, d.L, coulomb(d.mu_0, 0.64), "=15*sin(7*t)", stop(bottom, "bottom"), stop(top, "top"));
}

// Everything is held: the friction of the guide and the stops share forces. The drawer lets go where the pull exceeds
// mu_0 times the load by the moment of the pull alone, whatever the names of the stops are.
TEST(Drawer, LeavesItsStopsWhereThePullExceedsWhatItsGuideHolds) {
  const StoppedDrawer d;
  double low = 0.46, high = 0.6;  // it is pulled back from pi / 7 s on
  ASSERT_TRUE(-d.pull(low) < d.held(low) && -d.pull(high) > d.held(high));
  while (high - low > 1e-12) {
    const double t = (low + high) / 2;
    (-d.pull(t) < d.held(t) ? low : high) = t;
  }
  for (const std::string& scene : {stopped(d, "a", "b"), stopped(d, "b", "a")}) {
    const Finished run = run_text(scene);
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
    const std::vector<Event> slips = run.of_kind("slip");
    ASSERT_FALSE(slips.empty());
    EXPECT_NEAR(slips.back().t, high, 1e-8);
  }
}

// --- a box slides and drags an arm whose hinge rubs: floor and hinge share what holds the arm

struct DraggedArm {
  double box = 7, arm = 2.4, mu = 0.4, mu_tip = 0.2, mu_0 = 0.4, mu_hinge = 0.4, radius = 0.03, v_0 = 1;
  double x = 0.12, y = -0.125;  // from the hinge to the arm's centre; the tip is as far away from this
};

std::string dragged(const DraggedArm& d, const std::array<const char*, 3>& names) {
  std::string contacts;
  const auto on_floor = [&](const char* name, const char* marker, double mu) {
    contacts += fmt::format(R"({}"{}": {{"type": "constraint_method", "restitution": 0, "friction": {},
                                "between": ["{}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                            contacts.empty() ? "" : ", ", name, coulomb(mu), marker);
  };
  on_floor(names[0], "box.left", d.mu), on_floor(names[1], "box.right", d.mu), on_floor(names[2], "arm.tip", d.mu_tip);
  return fmt::format(R"({{
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {{
      "box": {{"type": "rigid_body", "mass": {0}, "inertia": 0.15, "position": [0, 0.15], "velocity": [{1}, 0],
               "markers": {{"left": [-0.2, -0.15], "right": [0.2, -0.15], "hinge": [0.2, {2}]}}}},
      "arm": {{"type": "rigid_body", "mass": {3}, "inertia": 0.03, "position": [{4}, {5}], "velocity": [{1}, 0],
               "markers": {{"hinge": [{6}, {7}], "tip": [{8}, {9}]}}}}}},
    "joints": {{"hinge": {{"type": "revolute", "between": ["box.hinge", "arm.hinge"], "radius": {10},
                           "friction": {11}}}}},
    "contacts": {{{12}}}, "simulate": {{"until": 0.1}},
    "record": {{"every": 0.05, "observe": {{"x": "box.com.x", "N": "contacts.{13}.force", "load": "joints.hinge.load",
                                           "T": "joints.hinge.friction"}}}}
  }})",
                     d.box, d.v_0, -2 * d.y - 0.15, d.arm, 0.2 + d.x, -d.y, -d.x, -d.y, d.x, d.y, d.radius,
                     coulomb(d.mu_0, d.mu_hinge), contacts, names[2]);
}

struct Sliding {
  double a = 0, R = 0;
  std::array<double, 4> F = {};  // at the left foot, the right one, the tip, and T of the hinge
};

// All move with one acceleration a. The arm:  arm a = R_x - mu_tip N,  0 = R_y + N - arm g,
// 0 = -x R_y + y R_x + (x + mu_tip y) N + radius T;  the hinge's T = side mu |R|.
Sliding slides_with_hinge_at_bound(const DraggedArm& d, double side) {
  Sliding s;
  const double all = d.box + d.arm, by_N = (d.mu - d.mu_tip) / all;  // a = -mu g + by_N N
  for (int round = 0; round < 100; ++round) {
    const double N = (d.x * d.arm * g + d.y * d.arm * d.mu * g - d.radius * s.F[3]) /
                     (2 * d.x + d.y * (d.arm * by_N + 2 * d.mu_tip));
    s.a = by_N * N - d.mu * g;
    const double R_x = d.arm * s.a + d.mu_tip * N, R_y = d.arm * g - N, feet = d.box * g + R_y;
    const double apart = (0.15 * d.mu * feet + (2 * d.y + 0.15) * R_x + d.radius * s.F[3]) / 0.2 + R_y;
    s.R = std::hypot(R_x, R_y);
    s.F = {(feet - apart) / 2, (feet + apart) / 2, N, side * d.mu_hinge * s.R};
  }
  return s;
}

// Along the self-stress of the floor and a unit T: positive where equal springs would lower T.
double pull_of_springs(const DraggedArm& d, const Sliding& s) {
  const double R_y = d.radius / (2 * d.x), apart = R_y + d.radius / 0.2;
  return s.F[0] * (R_y - apart) / 2 + s.F[1] * (R_y + apart) / 2 - s.F[2] * R_y + s.F[3];
}

// Equal springs would put more on the hinge than its friction can hold. It keeps its bound, on the side of the springs,
// and the floor carries the rest.
TEST(DraggedArm, LeansOnTheFloorWithWhatItsHingeCannotHold) {
  for (const double mu_tip : {0.1, 0.2, 0.3})
    for (const double mu_hinge : {0.3, 0.4})
      for (const auto& names : {std::array{"a", "b", "c"}, {"c", "b", "a"}, {"b", "c", "a"}}) {
        const DraggedArm d{.mu_tip = mu_tip, .mu_hinge = mu_hinge};
        const Sliding s = slides_with_hinge_at_bound(d, -1);
        ASSERT_GT(pull_of_springs(d, s), 0);
        const Finished run = run_text(dragged(d, names));
        ASSERT_TRUE(run.done()) << run.report.reason;
        EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
        EXPECT_NEAR(run.end("x"), d.v_0 * 0.1 + s.a * 0.01 / 2, 1e-9) << mu_tip << names[0];
        EXPECT_NEAR(run.end("N"), s.F[2], 1e-7) << mu_tip << names[0];
        EXPECT_NEAR(run.end("load"), s.R, 1e-7) << mu_tip << names[0];
        EXPECT_NEAR(std::abs(run.end("T")), mu_hinge * s.R, 1e-7) << mu_tip << names[0];
      }
}

// --- a drum that its hub and the shoe of a brake hold against a moment that grows

struct Brake {
  double press = 80, R = 0.15, r = 0.05, mu = 0.3, mu_hub = 0.4, inertia = 0.1, rate = 8;
  double holds() const { return mu * press * R + mu_hub * r * press * std::hypot(1, mu); }  // [N m]
};

std::string brake(const Brake& b, const std::array<const char*, 3>& names) {
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
           "bodies": {{"drum": {{"type": "rigid_body", "mass": 5, "inertia": {0}, "position": [0, 0]}},
                       "{1}": {{"type": "rigid_body", "mass": 1, "inertia": 0.002, "position": [0, 0.2],
                                "markers": {{"lining": [0, -0.05]}}}},
                       "frame": {{"type": "moving_base", "markers": {{"slide": [0, 0.2]}}}}}},
           "joints": {{"{2}": {{"type": "revolute", "between": ["ground", "drum.com"], "radius": {3}, "friction": {4}}},
                       "slide": {{"type": "prismatic", "between": ["frame.slide", "{1}.com"], "axis": [0, 1]}}}},
           "forces": {{"press": {{"type": "load", "on": "{1}.com", "force": {{"y": {5}}}}},
                       "moment": {{"type": "load", "on": "drum.com", "moment": "={6}*t"}}}},
           "contacts": {{"{7}": {{"type": "constraint_method", "restitution": 0, "radius": {8}, "friction": {9},
                           "between": ["drum.com", {{"plane": {{"point": [0, 0], "normal": [0, -1],
                                                                "on": "{1}.lining"}}}}]}}}},
           "simulate": {{"until": 0.8}},
           "record": {{"every": 0.01, "observe": {{"omega": "drum.angular_velocity", "T": "contacts.{7}.friction",
                                                  "load": "joints.{2}.load"}}}}}})",
      b.inertia, names[0], names[1], b.r, coulomb(b.mu_hub), -b.press, b.rate, names[2], b.R, coulomb(b.mu));
}

// It lets go where both are at their bounds, and the load of the hub is that of the forces that the shoe exerts then,
// not of those which it would exert as a spring beyond its bound.
TEST(BrakedDrum, TurnsWhereTheMomentExceedsWhatBothItsShoeAndItsHubHold) {
  const Brake b;
  const double turns = b.holds() / b.rate;
  for (const auto& names : {std::array{"a", "b", "c"}, {"c", "a", "b"}, {"b", "c", "a"}, {"z", "y", "x"}}) {
    const Finished run = run_text(brake(b, names));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
    const std::vector<Event> slips = run.of_kind("slip");
    ASSERT_EQ(slips.size(), 2);
    for (const Event& slip : slips) EXPECT_NEAR(slip.t, turns, 1e-8);
    EXPECT_NEAR(run.end("omega"), b.rate * (0.8 - turns) * (0.8 - turns) / (2 * b.inertia), 1e-8);
    for (std::size_t k = 0; k < run.series.at("load").size(); ++k)
      EXPECT_NEAR(run.series.at("load")[k], std::hypot(b.press, run.series.at("T")[k]), 1e-9 * b.press) << k;
  }
}

// --- a portal of two legs, each on two feet, hinged to a beam with friction: a push tips it

struct Portal {
  double leg = 2, beam = 4, mu = 0.5, radius = 0.06;
  double push = 15, press = 49;                  // [N/s] on the beam's centre
  double foot = 0.05, height = 1, hinge = 0.45;  // half the distance of the feet; half that of the hinges
};

std::string portal(const Portal& p, const std::array<const char*, 2>& legs) {
  std::string contacts, joints, bodies;
  for (const int k : {0, 1}) {
    const double side = k == 0 ? -1 : 1;
    bodies += fmt::format(R"("{0}": {{"type": "rigid_body", "mass": {1}, "inertia": 0.17, "position": [{2}, {3}],
                              "markers": {{"left": [{4}, {5}], "right": [{6}, {5}], "top": [0, {3}]}}}}, )",
                          legs[std::size_t(k)], p.leg, side * p.hinge, p.height / 2, -p.foot, -p.height / 2, p.foot);
    joints += fmt::format(R"({0}"{1}": {{"type": "revolute", "between": ["{1}.top", "beam.{2}"], "radius": {3},
                              "friction": {4}}})",
                          k == 0 ? "" : ", ", legs[std::size_t(k)], k == 0 ? "left" : "right", p.radius, coulomb(p.mu));
    for (const char* foot : {"left", "right"})
      contacts += fmt::format(R"({0}"{1}_{2}": {{"type": "constraint_method", "restitution": 0, "friction": {3},
                                  "between": ["{1}.{2}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                              contacts.empty() ? "" : ", ", legs[std::size_t(k)], foot, coulomb(0.6));
  }
  return fmt::format(R"({{
    "trammel": 1, "space": "planar", "gravity": [0, -{}],
    "bodies": {{{}"beam": {{"type": "rigid_body", "mass": {}, "inertia": 0.27, "position": [0, {}],
                            "markers": {{"left": [{}, 0], "right": [{}, 0]}}}}}},
    "joints": {{{}}}, "contacts": {{{}}},
    "forces": {{"push": {{"type": "load", "on": "beam.com", "force": {{"x": "={}*t", "y": "=-{}*t"}}}}}},
    "simulate": {{"until": 0.6}}, "record": {{"every": 0.1, "observe": {{"x": "beam.com.x"}}}}
  }})",
                     g, bodies, p.beam, p.height, -p.hinge, p.hinge, joints, contacts, p.push, p.press);
}

// Moments of each leg about its right foot, H height = foot (leg g + V) + mu radius |(H, V)|, and of the beam about its
// centre, hinge (V_right - V_left) = mu radius (|(H, V)_left| + |(H, V)_right|).
double tips_at(const Portal& p) {
  double t = 0;
  std::array<double, 2> M{};  // of the hinges
  for (int round = 0; round < 100; ++round) {
    const double both = M[0] + M[1];
    t = (p.foot * (2 * p.leg + p.beam) * g + both) / (p.push * p.height - p.press * p.foot);
    for (const int k : {0, 1}) {
      const double V = (p.beam * g + p.press * t) / 2 + (k == 0 ? -1 : 1) * both / (2 * p.hinge);
      M[std::size_t(k)] = p.mu * p.radius * std::hypot((p.foot * (p.leg * g + V) + M[std::size_t(k)]) / p.height, V);
    }
  }
  return t;
}

// Both hinges reach their bounds and both left feet lose their loads at one instant. Until then, forces within the
// bounds of all exist: none of them is an event of its own.
TEST(Portal, TipsWhereItsHingesSlipAndItsFeetOpenAtOnce) {
  for (const double mu : {0.1, 0.3, 0.5})
    for (const double radius : {0.02, 0.06})
      for (const double push : {15.0, 30.0, 40.0})
        for (const auto& legs : {std::array{"l", "r"}, {"r", "l"}, {"z", "c"}}) {
          const Portal p{.mu = mu, .radius = radius, .push = push};
          const Finished run = run_text(portal(p, legs));
          ASSERT_TRUE(run.done()) << run.report.reason;
          EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
          for (const char* kind : {"contact_open", "slip"}) {
            const std::vector<Event> events = run.of_kind(kind);
            ASSERT_GE(events.size(), 2) << kind;
            for (const int k : {0, 1}) EXPECT_NEAR(events[std::size_t(k)].t, tips_at(p), 1e-8) << kind << mu << push;
          }
          EXPECT_LE(run.result["counts"]["locating_steps"].get<int>(), 40) << mu << radius << push << legs[0];
        }
}

}  // namespace
}  // namespace trammel::test
