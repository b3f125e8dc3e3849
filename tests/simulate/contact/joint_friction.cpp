// Friction in joints against closed forms and references: guides that jam, journals with their friction circle.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "support/run_in_pieces.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr double g = 9.81;  // [m/s^2]
// Motions of constant acceleration: the method is exact, steps and events leave round-off of 1 s and 1 m.
constexpr double round_off = 1e-11;

std::string coulomb(double mu_0, double mu) {
  return fmt::format(R"({{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}})", mu_0, mu);
}
std::string coulomb(double mu) {
  return coulomb(mu, mu);
}

const std::string exact = R"({"type": "dop853", "step": {"tolerance": 1e-12}})";

// --- a drawer of 2 kg on a guide L long, pulled along it by F at the distance a beside it

struct Drawer {
  double L = 0.4, mu_0 = 0.25, mu = 0.25, F = 3, a = 0.5, v = 0;
  double mass = 2;
  double pressed() const { return 2 * F * a / L; }  // N at both ends of the guide
};

std::string drawer(const Drawer& d, const std::string& integrator = exact) {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, 0],
    "bodies": {{"drawer": {{"type": "rigid_body", "mass": {}, "inertia": 0.1, "velocity": [{}, 0],
                            "markers": {{"handle": [0, {:.17g}]}}}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "drawer.com"], "length": {}, "friction": {}}}}},
    "forces": {{"pull": {{"type": "load", "on": "drawer.handle", "force": {{"x": {}}}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"x": "drawer.com.x", "v": "drawer.com.vx", "N": "joints.guide.load",
                "T": "joints.guide.friction", "s": "joints.guide.slip", "sticks": "joints.guide.sticks"}}}}
  }})",
                     d.mass, d.v, d.a, d.L, coulomb(d.mu_0, d.mu), d.F, integrator);
}

TEST(Drawer, SlidesWherePulledNearerThanItsOverhangAndJamsBeyond) {
  Drawer d;
  const double overhang = d.L / (2 * d.mu);
  d.a = 0.999 * overhang;
  const Finished slides = run_text(drawer(d));
  ASSERT_TRUE(slides.done()) << slides.report.reason;
  const double acceleration = d.F * (1 - d.a / overhang) / d.mass;
  EXPECT_NEAR(slides.end("x"), acceleration / 2, round_off);
  EXPECT_NEAR(slides.end("N"), d.pressed(), round_off);
  EXPECT_NEAR(slides.end("T"), -d.mu * d.pressed(), round_off);
  ASSERT_EQ(slides.events.size(), 1u);
  EXPECT_EQ(slides.events[0].kind, "slip");
  EXPECT_EQ(slides.events[0].contact, "joints.guide");

  d.a = 1.001 * overhang;
  const Finished jams = run_text(drawer(d));
  ASSERT_TRUE(jams.done()) << jams.report.reason;
  EXPECT_NEAR(jams.end("x"), 0, round_off);
  EXPECT_NEAR(jams.end("T"), -d.F, round_off);
  EXPECT_EQ(jams.end("sticks"), 1);
}

TEST(Drawer, ThatSlidesIsBroughtToRestBeyondItsOverhang) {
  Drawer d;
  d.v = 0.5;
  const double overhang = d.L / (2 * d.mu);
  d.a = 1.5 * overhang;
  const Finished run = run_text(drawer(d));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double deceleration = d.F * (d.a / overhang - 1) / d.mass, until = d.v / deceleration;
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  EXPECT_NEAR(run.of_kind("stick")[0].t, until, round_off);
  EXPECT_NEAR(run.end("x"), d.v * until / 2, round_off);
  const double lost = d.mu * d.pressed() * d.v * until / 2;
  EXPECT_NEAR(run.result["energy_dissipated"]["joint_friction"]["guide"], lost, round_off);
  EXPECT_NEAR(run.result["energy_drift"], 0, round_off);
}

class OnEveryIntegrator : public testing::TestWithParam<const char*> {};

TEST_P(OnEveryIntegrator, TheDrawerStopsInTheSameTime) {
  Drawer d;
  d.v = 0.5;
  d.a = 1.5 * d.L / (2 * d.mu);
  const Finished run = run_text(drawer(d, fmt::format(R"({{"type": "{}", "step": 1e-3}})", GetParam())));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double until = d.v / (0.5 * d.F / d.mass);
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  EXPECT_NEAR(run.of_kind("stick")[0].t, until, 1e-9);  // polynomial motion: exact up to the iteration
  EXPECT_NEAR(run.end("x"), d.v * until / 2, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, OnEveryIntegrator,
                         testing::Values("hht_alpha", "newmark", "generalized_alpha", "adams_baumgarte",
                                         "runge_kutta_4", "dormand_prince", "dop853"));

// A block of 1 kg on a guide that is inclined by phi; no length: only the force across rubs.
std::string incline(double phi, double mu, double v, const std::string& more = "") {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": 0.1, "velocity": [{:.17g}, {:.17g}]}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "block.com"], "axis": [{:.17g}, {:.17g}],
                           "friction": {}{}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"x": "block.com.x", "y": "block.com.y", "T": "joints.guide.friction"}}}}
  }})",
                     v * std::cos(phi), v * std::sin(phi), std::cos(phi), std::sin(phi), coulomb(mu), more, exact);
}

TEST(Incline, HoldsAGuidedBlockUpToTheFrictionAngle) {
  const double mu = 0.6, angle = std::atan(mu);
  const Finished stays = run_text(incline(angle - 1e-6, mu, 0));
  ASSERT_TRUE(stays.done()) << stays.report.reason;
  EXPECT_NEAR(stays.end("x"), 0, round_off);
  EXPECT_NEAR(stays.end("T"), g * std::sin(angle - 1e-6), round_off);
  const double phi = angle + 1e-3;
  const Finished slides = run_text(incline(phi, mu, 0));
  ASSERT_TRUE(slides.done()) << slides.report.reason;
  EXPECT_NEAR(slides.end("x"), -g / 2 * (std::sin(phi) - mu * std::cos(phi)) * std::cos(phi), round_off);
}

TEST(Incline, BlockThrownUpTurnsBackOrStays) {
  const double phi = pi / 6, v = 2;
  const Finished back = run_text(incline(phi, 0.3, v));
  const double up = g * (std::sin(phi) + 0.3 * std::cos(phi)), down = g * (std::sin(phi) - 0.3 * std::cos(phi));
  ASSERT_EQ(back.of_kind("reversal").size(), 1u) << back.report.reason;
  EXPECT_NEAR(back.of_kind("reversal")[0].t, v / up, round_off);
  const double left = 1 - v / up;
  EXPECT_NEAR(back.end("x") / std::cos(phi), v * v / (2 * up) - down * left * left / 2, round_off);
  const Finished stays = run_text(incline(phi, 0.6, v));
  EXPECT_EQ(stays.of_kind("stick").size(), 1u) << stays.report.reason;
}

// --- pulled through a spring at the speed V: stick-slip with mu < mu_0

TEST(StickSlip, OfAGuideIsTheClosedFormOfABlockOnABelt) {
  const double mu_0 = 0.5, mu = 0.3, k = 40, V = 0.2;
  const Finished run = run_text(fmt::format(R"({{
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": 0.1}},
                "puller": {{"type": "moving_base", "x": "={}*t"}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "block.com"], "friction": {}}}}},
    "forces": {{"spring": {{"type": "bushing", "between": ["puller.origin", "block.com"], "stiffness": [{}, 0]}}}},
    "integrator": {}, "simulate": {{"until": 3}}, "record": {{"every": 0.1, "observe": {{"x": "block.com.x"}}}}
  }})",
                                            V, coulomb(mu_0, mu), k, exact));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double omega = std::sqrt(k), A = (mu_0 - mu) * g / k;
  const double sticks = mu_0 * g / (k * V), slides = (2 * pi - 2 * std::atan(A * omega / V)) / omega;
  const std::vector<Event> slip = run.of_kind("slip"), stick = run.of_kind("stick");
  ASSERT_GE(slip.size(), 1u);
  ASSERT_GE(stick.size(), 2u);  // the first at t = 0
  EXPECT_NEAR(slip[0].t, sticks, 1e-9);
  EXPECT_NEAR(stick[1].t, sticks + slides, 1e-9);
}

// --- journals

// A wheel of 3 kg on a journal of radius r, loaded by the force W at the distance d beside its axis, and driven by a
// moment.
std::string wheel(double r, double mu, double W, double d, double spin, double moment = 0,
                  const std::string& integrator = exact) {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, 0],
    "bodies": {{"wheel": {{"type": "rigid_body", "mass": 3, "inertia": 0.2, "angular_velocity": {}, "markers": {{"rim": [{:.17g}, 0]}}}}}},
    "joints": {{"journal": {{"type": "revolute", "between": ["ground", "wheel.com"], "radius": {}, "friction": {}}}}},
    "forces": {{"weight": {{"type": "load", "on": "wheel.rim", "force": {{"y": {:.17g}}}}},
                "drive": {{"type": "load", "on": "wheel.com", "moment": {:.17g}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"angle": "wheel.angle", "T": "joints.journal.friction", "N": "joints.journal.load",
                "s": "joints.journal.slip"}}}}
  }})",
                     spin, d, r, coulomb(mu), -W, moment, integrator);
}

TEST(Journal, IsHeldByForcesThatCrossItsFrictionCircle) {
  const double r = 0.02, mu = 0.3, W = 50, circle = mu * r;
  const Finished holds = run_text(wheel(r, mu, W, 0.999 * circle, 0));
  ASSERT_TRUE(holds.done()) << holds.report.reason;
  EXPECT_NEAR(holds.end("angle"), 0, round_off);
  EXPECT_NEAR(r * holds.end("T"), 0.999 * circle * W, round_off);
  const Finished turns = run_text(wheel(r, mu, W, 1.001 * circle, 0), {{"simulate.until", "0.001"}});
  ASSERT_TRUE(turns.done()) << turns.report.reason;
  // So short that the arm keeps its length.
  EXPECT_NEAR(turns.end("angle"), -0.001 * circle * W / 0.2 * 1e-6 / 2, 1e-16);
}

TEST(Journal, TurnsByTheTorqueMuRTimesItsLoad) {
  const double r = 0.02, mu = 0.3, W = 50, torque = mu * r * W, moment = 0.7;
  const Finished run = run_text(wheel(r, mu, W, 0, 0, moment));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("angle"), (moment - torque) / 0.2 / 2, round_off);
  EXPECT_NEAR(run.end("N"), W, round_off);
  EXPECT_NEAR(r * run.end("T"), -torque, round_off);
}

TEST(Journal, StopsARotorUnderRadialLoadInTheClosedFormsTime) {
  const double r = 0.02, mu = 0.3, W = 50, spin = -1.2;
  const double deceleration = mu * r * W / 0.2;
  const Finished run = run_text(wheel(r, mu, W, 0, spin));
  ASSERT_EQ(run.of_kind("stick").size(), 1u) << run.report.reason;
  EXPECT_NEAR(run.of_kind("stick")[0].t, -spin / deceleration, round_off);
  EXPECT_NEAR(run.end("angle"), -spin * spin / (2 * deceleration), round_off);
  EXPECT_NEAR(run.result["energy_dissipated"]["joint_friction"]["journal"], 0.2 * spin * spin / 2, round_off);
}

// A pendulum of 1 kg, l from its journal to the centre of mass.
constexpr double l = 0.5, J = 0.05, journal = 0.05, mu_journal = 0.4;

std::string pendulum(double angle, double until, const std::string& integrator = exact) {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {{"rod": {{"type": "rigid_body", "mass": 1, "inertia": {}, "angle": {:.17g},
                         "position": [{:.17g}, {:.17g}], "markers": {{"hinge": [0, {}]}}}}}},
    "joints": {{"hinge": {{"type": "revolute", "between": ["ground", "rod.hinge"], "radius": {}, "friction": {}}}}},
    "integrator": {}, "simulate": {{"until": {:.17g}}},
    "record": {{"every": {:.17g}, "observe": {{"angle": "rod.angle", "rate": "rod.angular_velocity", "N": "joints.hinge.load"}}}}
  }})",
                     J, angle, l * std::sin(angle), -l * std::cos(angle), l, journal, coulomb(mu_journal), integrator,
                     until, until / 10);
}

// angle'' of that pendulum while it turns the way `sign` says: (J + l^2) angle'' = -g l sin - sign mu r |R|, R with
// angle''.
double angular_acceleration(double angle, double rate, double sign) {
  double alpha = 0;
  for (int i = 0; i < 200; ++i) {
    const double R_t = l * alpha + g * std::sin(angle), R_n = l * rate * rate + g * std::cos(angle);
    alpha = (-g * l * std::sin(angle) - sign * mu_journal * journal * std::hypot(R_t, R_n)) / (J + l * l);
  }
  return alpha;
}

// By RK4 with 20,000 steps: its error is below 1e-13.
double reference_angle(double angle, double until) {
  double rate = 0;
  const int n = 20000;
  const double h = until / n;
  for (int i = 0; i < n; ++i) {
    const auto f = [](double x, double v) { return angular_acceleration(x, v, -1); };
    const double k1 = f(angle, rate), k2 = f(angle + h / 2 * rate, rate + h / 2 * k1);
    const double k3 = f(angle + h / 2 * (rate + h / 2 * k1), rate + h / 2 * k2);
    const double k4 = f(angle + h * (rate + h / 2 * k2), rate + h * k3);
    angle += h * rate + h * h / 6 * (k1 + k2 + k3);
    rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return angle;
}

TEST(JournalOfAPendulum, RubsUnderTheForceOfItsSwing) {
  const double until = 0.5;  // before it comes to its first turn
  const Finished run = run_text(pendulum(1.2, until));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("angle"), reference_angle(1.2, until), 1e-10);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-10);
  EXPECT_GT(run.result["energy_dissipated"]["joint_friction"]["hinge"], 0.1);
}

TEST(JournalOfAPendulum, BringsItToRestWhereItsWeightStaysInTheFrictionCircle) {
  const Finished run = run_text(pendulum(1.2, 30));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.events.back().kind, "stick");
  EXPECT_LE(std::abs(l * std::sin(run.end("angle"))), mu_journal * journal * (1 + 1e-9));
  EXPECT_NEAR(run.end("N"), g, 1e-9);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9);
}

// --- orders within a phase of sliding, whose reaction and friction change with the motion

double error_of(const char* integrator, double h) {
  const double until = 0.4;
  const Finished run =
      run_text(pendulum(1.2, until, fmt::format(R"({{"type": "{}", "step": {:.17g}}})", integrator, h)));
  EXPECT_TRUE(run.done()) << run.report.reason;
  static const double reference = reference_angle(1.2, until);
  return std::abs(run.end("angle") - reference);
}

TEST(JournalOfAPendulum, KeepsTheOrdersOfTheMethods) {
  const std::pair<const char*, double> orders[] = {
      {"newmark", 2}, {"hht_alpha", 2}, {"generalized_alpha", 2}, {"runge_kutta_4", 4}, {"dormand_prince", 5}};
  for (const auto& [integrator, order] : orders) {
    const double coarse = error_of(integrator, order == 5 ? 0.04 : 0.02),
                 fine = error_of(integrator, order == 5 ? 0.02 : 0.01);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.35) << integrator << " " << coarse << " " << fine;
  }
}

// --- in space

const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();

std::string list(const Eigen::Vector3d& x) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x.x(), x.y(), x.z());
}
std::string in_space(double x, double y) {
  return list(turned * Eigen::Vector3d(x, y, 0));
}

TEST(InSpace, TheDrawerSlidesAndJamsAsInThePlane) {
  for (const double part : {0.8, 1.5}) {
    Drawer d;
    d.v = 0.5;
    d.a = part * d.L / (2 * d.mu);
    const Finished plane = run_text(drawer(d));
    const Eigen::Vector3d pull = turned * Eigen::Vector3d(d.F, 0, 0);
    const Finished space = run_text(fmt::format(
        R"({{
      "trammel": 1, "space": "spatial",
      "bodies": {{"drawer": {{"type": "rigid_body", "mass": {}, "inertia": [0.1, 0.1, 0.1], "velocity": {},
                              "markers": {{"handle": {}}}}}}},
      "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "drawer.com"], "axis": {}, "length": {}, "friction": {}}}}},
      "forces": {{"pull": {{"type": "load", "on": "drawer.handle", "force": {{"x": {:.17g}, "y": {:.17g}, "z": {:.17g}}}}}}},
      "integrator": {}, "simulate": {{"until": 1}},
      "record": {{"every": 0.1, "observe": {{"s": "joints.guide.slip", "T": "joints.guide.friction", "N": "joints.guide.load"}}}}
    }})",
        d.mass, in_space(d.v, 0), in_space(0, d.a), in_space(1, 0), d.L, coulomb(d.mu), pull.x(), pull.y(), pull.z(),
        exact));
    ASSERT_TRUE(space.done()) << space.report.reason;
    for (const char* column : {"s", "T", "N"})
      for (std::size_t k = 0; k < plane.series.at(column).size(); ++k)
        EXPECT_NEAR(space.series.at(column)[k], plane.series.at(column)[k], 1e-10) << column << " " << k << " " << part;
  }
}

TEST(InSpace, ThePendulumSwingsAsInThePlane) {
  const double angle = 1.2, until = 3;
  const Finished plane = run_text(pendulum(angle, until));
  const Eigen::Vector3d weight = turned * Eigen::Vector3d(0, -g, 0), axis = turned * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d com(l * std::sin(angle), -l * std::cos(angle), 0);
  const Finished space = run_text(fmt::format(
      R"({{
    "trammel": 1, "space": "spatial", "gravity": {},
    "bodies": {{"rod": {{"type": "rigid_body", "mass": 1, "inertia": [{}, {}, {}], "position": {}, "markers": {{"hinge": {}}}}}}},
    "joints": {{"hinge": {{"type": "revolute", "between": ["ground", "rod.hinge"], "axis": {}, "radius": {}, "length": 0.1, "friction": {}}}}},
    "integrator": {}, "simulate": {{"until": {:.17g}}},
    "record": {{"every": {:.17g}, "observe": {{"s": "joints.hinge.slip", "N": "joints.hinge.load"}}}}
  }})",
      list(weight), J, J, J, list(turned * com), list(turned * -com), list(axis), journal, coulomb(mu_journal), exact,
      until, until / 10));
  ASSERT_TRUE(space.done()) << space.report.reason;
  for (std::size_t k = 0; k < plane.series.at("rate").size(); ++k) {
    EXPECT_NEAR(space.series.at("s")[k], journal * plane.series.at("rate")[k], 1e-9) << k;
    EXPECT_NEAR(space.series.at("N")[k], plane.series.at("N")[k], 1e-8) << k;
  }
}

// A rotor of 3 kg on a shaft through its centre of mass, c above the middle of the journal along the shaft's axis.
std::string rotor(const Eigen::Vector3d& gravity, double c, double spin, const std::string& length) {
  return fmt::format(R"({{
    "trammel": 1, "space": "spatial", "gravity": {},
    "bodies": {{"rotor": {{"type": "rigid_body", "mass": 3, "inertia": [0.15, 0.15, 0.2], "angular_velocity": [0, 0, {}],
                           "markers": {{"journal": [0, 0, {}]}}, "position": [0, 0, {}]}}}},
    "joints": {{"journal": {{"type": "revolute", "between": ["ground", "rotor.journal"], "radius": 0.02, "friction": {}{}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"N": "joints.journal.load"}}}}
  }})",
                     list(gravity), spin, -c, c, coulomb(0.3), length, exact);
}

void expect_stop(const std::string& scene, double load, double spin) {
  const Finished run = run_text(scene);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.series.at("N")[0], load, 1e-10);
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  EXPECT_NEAR(run.of_kind("stick")[0].t, 0.2 * spin / (0.3 * 0.02 * load), 1e-10);
}

TEST(InSpace, ThrustRubsAtTheRadiusOfTheJournal) {
  expect_stop(rotor({0, 0, -g}, 0, 0.5, ""), 3 * g, 0.5);
}

TEST(InSpace, AnOverhungRotorPressesAtBothEndsOfItsJournal) {
  const double c = 0.15, L = 0.1;
  expect_stop(rotor({0, -g, 0}, c, 0.5, R"(, "length": 0.1)"), 2 * 3 * g * c / L, 0.5);
  expect_stop(rotor({0, -g, 0}, c, 0.5, ""), 3 * g, 0.5);  // a bearing that aligns itself
}

TEST(InSpace, AMomentAboutTheGuideRubsOnItsRails) {
  const double moment = 6, b = 0.3, v = 1;
  const Finished run = run_text(fmt::format(R"({{
    "trammel": 1, "space": "spatial",
    "bodies": {{"slide": {{"type": "rigid_body", "mass": 2, "inertia": [0.1, 0.1, 0.1], "velocity": [0, {}, 0]}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "slide.com"], "axis": [0, 1, 0], "width": {}, "friction": {}}}}},
    "forces": {{"twist": {{"type": "load", "on": "slide.com", "torque": {{"y": {}}}}}}},
    "integrator": {}, "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"N": "joints.guide.load"}}}}
  }})",
                                            v, b, coulomb(0.2), moment, exact));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("N"), 2 * moment / b, 1e-10);
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  EXPECT_NEAR(run.of_kind("stick")[0].t, v * 2 / (0.2 * 2 * moment / b), 1e-10);
}

// --- smooth laws

TEST(SmoothFriction, LetsAJammedDrawerCreep) {
  Drawer d;
  const double overhang = d.L / (2 * d.mu), v_c = 0.01;
  d.a = 1.5 * overhang;
  const std::string law =
      fmt::format(R"({{"type": "regularized_coulomb", "coefficient": {}, "critical_velocity": {}}})", d.mu, v_c);
  for (const char* integrator : {"hht_alpha", "dop853"}) {
    const Finished run = run_text(drawer(d, fmt::format(R"({{"type": "{}", "step": 1e-3}})", integrator)),
                                  {{"joints.guide.friction", law}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    // F = mu N tanh(v / v_c) where it creeps evenly, which it does after some v_c m / (mu N) = 1 ms.
    EXPECT_NEAR(run.end("v"), v_c * std::atanh(overhang / d.a), 1e-8) << integrator;
    EXPECT_TRUE(run.events.empty()) << integrator;
  }
}

TEST(SmoothFriction, IsWhatADriveHasToOvercome) {
  Drawer d;
  d.v = 0.2;
  const std::string law = R"({"type": "regularized_coulomb", "coefficient": 0.25, "critical_velocity": 1e-3})";
  const Finished run = run_text(drawer(d), {{"joints.guide.friction", law}, {"joints.guide.position", "=0.2*t"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double lost = d.mu * d.pressed() * 0.2;  // in 1 s; tanh(200) is 1
  EXPECT_NEAR(run.result["energy_dissipated"]["joint_friction"]["guide"], lost, round_off);
  EXPECT_NEAR(run.result["energy_supplied"]["constraints"], lost - d.F * 0.2, round_off);
}

// --- resuming, and what is refused

TEST(JointFriction, ResumesToTheSameBits) {
  const scene::Scene scene = scene::Scene::parse(pendulum(1.2, 3), "test.json", {});
  const Logs whole = run_in_pieces(scene, 1000000), pieces = run_in_pieces(scene, 7);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
}

std::string refusal(const std::string& text, const Overrides& overrides) {
  try {
    run_text(text, overrides);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(JointFriction, IsRefusedWhereItCannotBe) {
  EXPECT_THAT(refusal(pendulum(1.2, 1), {{"joints.hinge.radius", "null"}}),
              HasSubstr("joints.hinge.radius: friction turns about a journal: give its radius [m]"));
  EXPECT_THAT(refusal(pendulum(1.2, 1), {{"joints.hinge.radius", "0"}}), HasSubstr("joints.hinge.radius"));
  EXPECT_THAT(refusal(pendulum(1.2, 1), {{"joints.hinge.length", "0.1"}}),
              HasSubstr("joints.hinge.length: this scene is planar"));
  EXPECT_THAT(refusal(drawer({}), {{"joints.guide.width", "0.1"}}),
              HasSubstr("joints.guide.width: this scene is planar"));
  EXPECT_THAT(refusal(drawer({}), {{"joints.guide.position", "0"}}),
              HasSubstr("joints.guide.friction: the joint's motion follows a law of time"));
  EXPECT_THAT(refusal(drawer({}), {{"joints.guide.friction.method", "lcp_every_step"},
                                   {"joints.guide.friction.stick_speed", "1e-6"}}),
              HasSubstr("joints.guide.friction: friction that is decided at every evaluation"));
  EXPECT_THAT(
      refusal(drawer({}), {{"joints.tie", R"({"type": "distance", "between": ["ground", "drawer.handle"], "length": 0.5,
                                                       "friction": {"type": "coulomb", "static": 0.3, "kinetic": 0.3}})"}}),
      HasSubstr("joints.tie.friction: this joint has no bearing that could rub"));
}

}  // namespace
}  // namespace trammel::test
