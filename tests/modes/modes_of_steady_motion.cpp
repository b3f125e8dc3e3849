// Modes about steady motions of spinning bodies held by joints, against closed forms.
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "run/run_failed.hpp"
#include "support/modes_of.hpp"

namespace trammel::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;
using testing::HasSubstr;

simulate::ModesOptions steady() {
  simulate::ModesOptions options;
  options.steady = true, options.count = 20;
  return options;
}

std::string vec(const Vector3d& x) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x(0), x(1), x(2));
}

// A body on a ball joint at the origin with its centre of mass l along its third axis, at an orientation and angular
// velocity.
struct Top {
  double mass = 1.3, l = 0.4, g = 9.81;
  Vector3d inertia{0.05, 0.05, 0.03};  // about the centre of mass
  Matrix3d R = Matrix3d::Identity();
  Vector3d omega = Vector3d::Zero();  // world axes

  double about_foot() const { return inertia(0) + mass * l * l; }
  double pull() const { return mass * g * l; }
  std::string scene() const {
    const Vector3d r = R * Vector3d(0, 0, l);
    const Eigen::Quaterniond p(R);
    return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, {:.17g}],
      "bodies": {{"top": {{"type": "rigid_body", "mass": {:.17g}, "inertia": {}, "position": {}, "velocity": {},
                           "orientation": [{:.17g}, {:.17g}, {:.17g}, {:.17g}], "angular_velocity": {},
                           "markers": {{"foot": [0, 0, {:.17g}]}}}}}},
      "joints": {{"foot": {{"type": "spherical", "between": ["ground", "top.foot"]}}}}, "simulate": {{"until": 1}}}})",
                       -g, mass, vec(inertia), vec(r), vec(omega.cross(r)), p.w(), p.x(), p.y(), p.z(),
                       vec(R.transpose() * omega), -l);
  }
};

// Differences of K and the round-off of the eigenvalues, some 1e-9 of the fastest rate.
constexpr double close = 1e-7;

// I1 z'' - i I3 w z' - m g l z = 0 of the tilt z = x + i y, in the world: slow precession and fast nutation.
TEST(ModesOfSteadyMotion, ASleepingTopPrecessesAndNutates) {
  for (const double of_limit : {1.0001, 1.1, 1.3, 3.0, 30.0}) {
    Top top;
    const double I1 = top.about_foot(), I3 = top.inertia(2), limit = std::sqrt(4 * I1 * top.pull()) / I3;
    const double w = of_limit * limit, root = std::sqrt(I3 * I3 * w * w - 4 * I1 * top.pull());
    const double slow = 2 * top.pull() / (I3 * w + root), fast = (I3 * w + root) / (2 * I1);
    top.omega = {0, 0, w};
    for (const bool asked : {true, false}) {
      const Modes modes = modes_of(top.scene(), {}, asked ? steady() : simulate::ModesOptions{});
      EXPECT_EQ(modes.result["unstable"], 0);
      EXPECT_EQ(modes.result["coefficients"], "constant");
      const std::vector<double> found = modes.oscillations();
      ASSERT_EQ(found.size(), 2u) << of_limit;
      // At the limit both meet, and K's error e parts them by sqrt(e).
      const double tolerance = of_limit < 1.01 ? 1e-4 * fast : close * w;
      EXPECT_NEAR(found[0], slow, tolerance) << of_limit;
      EXPECT_NEAR(found[1], fast, tolerance) << of_limit;
    }
  }
}

TEST(ModesOfSteadyMotion, ASlowSleepingTopFalls) {
  for (const double of_limit : {0.1, 0.6, 0.99}) {
    Top top;
    const double I1 = top.about_foot(), I3 = top.inertia(2), w = of_limit * std::sqrt(4 * I1 * top.pull()) / I3;
    top.omega = {0, 0, w};
    const Modes modes = modes_of(top.scene(), {}, steady());
    EXPECT_EQ(modes.result["unstable"], 1);
    EXPECT_NEAR(modes.growth(), std::sqrt(4 * I1 * top.pull() - I3 * I3 * w * w) / (2 * I1), 1e-6);
  }
}

// A top without symmetry is steady in its own axes alone, A and B about the foot:
//     (A s^2 + (C-B) w^2 - P)(B s^2 + (C-A) w^2 - P) + (A+B-C)^2 w^2 s^2 = 0
TEST(ModesOfSteadyMotion, ASleepingTopWithoutSymmetryIsSeenFromItsOwnAxes) {
  Top top;
  top.inertia = {0.05, 0.08, 0.06};
  const double more = top.mass * top.l * top.l, A = top.inertia(0) + more, B = top.inertia(1) + more,
               C = top.inertia(2);
  for (const double w : {60.0, 100.0}) {
    top.omega = {0, 0, w};
    const Modes modes = modes_of(top.scene(), {}, steady());
    const double P = top.pull(), a = (C - B) * w * w - P, b = (C - A) * w * w - P;
    const double p = A * b + B * a + std::pow((A + B - C) * w, 2), root = std::sqrt(p * p - 4 * A * B * a * b);
    const double fast = std::sqrt((p + root) / (2 * A * B)), slow = std::sqrt(a * b / (A * B)) / fast;
    EXPECT_NEAR(modes.result["frame_rate"][2], w, 1e-9 * w);
    const std::vector<double> found = modes.oscillations();
    ASSERT_EQ(found.size(), 2u) << w;
    EXPECT_NEAR(found[0], slow, close * w) << w;
    EXPECT_NEAR(found[1], fast, close * w) << w;
  }
}

// Regular precession at Omega with tilt theta: m g l = I3 w3 Omega - I1 Omega^2 cos theta. It nutates at
//     omega_n^2 = ((I3 w3 - 2 I1 Omega cos theta)/I1)^2 + (Omega sin theta)^2,
// by the effective potential of theta at constant momenta.
struct Precession {
  Top top;
  double Omega, nutation;
};
Precession precession(double theta, double azimuth, double Omega) {
  Precession p{{}, Omega, 0};
  const double I1 = p.top.about_foot(), I3 = p.top.inertia(2), c = std::cos(theta), s = std::sin(theta);
  const double b = (p.top.pull() + I1 * Omega * Omega * c) / Omega;  // I3 w3
  p.top.R =
      (Eigen::AngleAxisd(azimuth, Vector3d::UnitZ()) * Eigen::AngleAxisd(theta, Vector3d::UnitY())).toRotationMatrix();
  const Vector3d axis = p.top.R.col(2);
  p.top.omega = Omega * Vector3d::UnitZ() + (b / I3 - Omega * c) * axis;
  p.nutation = std::hypot(b / I1 - 2 * Omega * c, Omega * s);
  return p;
}

TEST(ModesOfSteadyMotion, ATopInRegularPrecessionNutates) {
  std::mt19937 random(3);
  for (int i = 0; i < 12; ++i) {
    const double theta = std::uniform_real_distribution(0.2, 2.8)(random);
    const double Omega = std::uniform_real_distribution(0.5, 15.0)(random);
    const Precession p = precession(theta, std::uniform_real_distribution(0.0, 6.28)(random), Omega);
    const Modes modes = modes_of(p.top.scene(), {}, steady());
    EXPECT_NEAR(modes.result["frame_rate"][2], Omega, 1e-7 * p.top.omega.norm()) << theta;
    EXPECT_EQ(modes.result["unstable"], 0);
    const std::vector<double> found = modes.oscillations();
    ASSERT_EQ(found.size(), 1u) << theta << " " << Omega;
    EXPECT_NEAR(found[0], p.nutation, close * p.top.omega.norm()) << theta << " " << Omega;
  }
}

// Rates written with a few digits: the nearest regular precession is found, whose nutation differs by as much as they
// did.
TEST(ModesOfSteadyMotion, ATopNearlyInPrecessionNutatesAsItsNeighbour) {
  for (const double off : {1e-6, 1e-4, 1e-2}) {
    Precession p = precession(0.7, 0.3, 4);
    const double spin = p.top.omega.norm();
    p.top.omega += off * Vector3d(0.5, -0.3, 1);
    const Modes modes = modes_of(p.top.scene(), {}, steady());
    ASSERT_EQ(modes.oscillations().size(), 1u) << off;
    EXPECT_EQ(modes.result["unstable"], 0);
    EXPECT_NEAR(modes.oscillations()[0], p.nutation, 2 * off + close * spin) << off;
  }
}

// The same of a rotor on a hinge at the end of an arm that goes round with the precession and does not spin: I3 w3 is
// the momentum of both along the axis, I1 the moment of both about the foot.
TEST(ModesOfSteadyMotion, ARotorOnAnArmInRegularPrecessionNutates) {
  const double g = 9.81, C_arm = 0.002, C_rotor = 0.03;
  const double I1 = 0.01 + 0.5 * 0.2 * 0.2 + 0.02 + 1.3 * 0.4 * 0.4, pull = g * (0.5 * 0.2 + 1.3 * 0.4);
  for (const double theta : {0.4, pi / 2, 2.0})
    for (const double Omega : {1.5, 9.0}) {
      const double c = std::cos(theta), s = std::sin(theta);
      const double b = (pull + I1 * Omega * Omega * c) / Omega, spin = (b - C_arm * Omega * c) / C_rotor;
      const Matrix3d R = Eigen::AngleAxisd(theta, Vector3d::UnitY()).toRotationMatrix();
      const Vector3d e = R.col(2), round = Omega * Vector3d::UnitZ(), of_rotor = round + (spin - Omega * c) * e;
      const auto body = [&](double mass, const char* inertia, double at, const Vector3d& omega, const char* markers) {
        return fmt::format(R"({{"type": "rigid_body", "mass": {}, "inertia": {}, "position": {}, "velocity": {},
          "axis": [0, 1, 0], "angle": {:.17g}, "angular_velocity": {}, "markers": {}}})",
                           mass, inertia, vec(at * e), vec(round.cross(at * e)), theta, vec(R.transpose() * omega),
                           markers);
      };
      const Modes modes = modes_of(
          fmt::format(
              R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81], "bodies": {{"arm": {}, "rotor": {}}},
        "joints": {{"foot": {{"type": "spherical", "between": ["ground", "arm.foot"]}},
                    "axle": {{"type": "revolute", "between": ["arm.end", "rotor.com"], "axis": [0, 0, 1]}}}},
        "simulate": {{"until": 1}}}})",
              body(0.5, "[0.01, 0.01, 0.002]", 0.2, round, R"({"foot": [0, 0, -0.2], "end": [0, 0, 0.2]})"),
              body(1.3, "[0.02, 0.02, 0.03]", 0.4, of_rotor, "{}")),
          {}, steady());
      EXPECT_NEAR(modes.result["frame_rate"][2], Omega, 1e-7 * of_rotor.norm());
      EXPECT_EQ(modes.result["unstable"], 0);
      ASSERT_EQ(modes.oscillations().size(), 1u) << theta << " " << Omega;
      EXPECT_NEAR(modes.oscillations()[0], std::hypot(b / I1 - 2 * Omega * c, Omega * s), close * of_rotor.norm());
    }
}

// A free body that turns about its axis of symmetry: the tilt goes with I3/I1 w in the world.
TEST(ModesOfSteadyMotion, AFreeBodyWobbles) {
  for (const double w : {2.0, 50.0}) {
    const Modes modes = modes_of(fmt::format(R"({{"trammel": 1, "space": "spatial",
      "bodies": {{"body": {{"type": "rigid_body", "mass": 1, "inertia": [1, 1, 1.7], "angular_velocity": [0, 0, {}]}}}},
      "simulate": {{"until": 1}}}})",
                                             w),
                                 {}, steady());
    ASSERT_EQ(modes.oscillations().size(), 1u);
    EXPECT_NEAR(modes.oscillations()[0], 1.7 * w, close * w);
    EXPECT_EQ(modes.result["unstable"], 0);
  }
}

// A rotor of momentum H in two gimbals, J1 about the outer axis and J2 about the inner one: it nutates with H/sqrt(J1
// J2).
std::string gyroscope(double spin, const char* rotor_inertia) {
  return fmt::format(R"({{"trammel": 1, "space": "spatial",
    "bodies": {{"outer": {{"type": "rigid_body", "mass": 1, "inertia": [0.12, 0.2, 0.1]}},
                "inner": {{"type": "rigid_body", "mass": 1, "inertia": [0.04, 0.07, 0.035]}},
                "rotor": {{"type": "rigid_body", "mass": 2, "inertia": {}, "angular_velocity": [0, {:.17g}, 0]}}}},
    "joints": {{"outer": {{"type": "revolute", "between": ["ground", "outer.com"], "axis": [0, 0, 1]}},
                "inner": {{"type": "revolute", "between": ["outer.com", "inner.com"], "axis": [1, 0, 0]}},
                "rotor": {{"type": "revolute", "between": ["inner.com", "rotor.com"], "axis": [0, 1, 0]}}}},
    "simulate": {{"until": 1}}}})",
                     rotor_inertia, spin);
}
TEST(ModesOfSteadyMotion, AGyroscopeInGimbalsNutates) {
  for (const double spin : {5.0, 100.0, -3000.0}) {
    const Modes modes = modes_of(gyroscope(spin, "[0.02, 0.035, 0.02]"), {}, steady());
    const double J1 = 0.1 + 0.035 + 0.02, J2 = 0.04 + 0.02, exact = 0.035 * std::abs(spin) / std::sqrt(J1 * J2);
    ASSERT_EQ(modes.oscillations().size(), 1u) << spin;
    EXPECT_NEAR(modes.oscillations()[0], exact, close * std::abs(spin)) << spin;
    EXPECT_EQ(modes.result["unstable"], 0);
  }
}

std::string failure_of(const std::string& scene) {
  try {
    modes_of(scene, {}, steady());
  } catch (const simulate::RunFailed& e) {
    return e.what();
  }
  return "";
}
// Its spin is steady; what the gimbals feel is not.
TEST(ModesOfSteadyMotion, ARotorWithoutSymmetryInGimbalsHasNone) {
  for (const char* inertia : {"[0.02, 0.035, 0.025]", "[0.02, 0.035, 0.020002]"})
    EXPECT_THAT(failure_of(gyroscope(100, inertia)), HasSubstr("coefficients that change with time")) << inertia;
}

TEST(ModesOfSteadyMotion, APendulumThatSwingsHasNone) {
  for (const char* rate : {"0.5", "3", "20"})
    EXPECT_THAT(failure_of(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
      "bodies": {{"bar": {{"type": "rigid_body", "mass": 2, "inertia": 0.3, "position": [0, -0.5], "angular_velocity": {0},
                           "velocity": ["=0.5*{0}", 0], "markers": {{"top": [0, 0.5]}}}}}},
      "joints": {{"hinge": {{"type": "revolute", "between": ["ground", "bar.top"]}}}}, "simulate": {{"until": 1}}}})",
                                       rate)),
                HasSubstr("no steady motion was found"))
        << rate;
}

// A rotor on a ball at its centre, at the end of an arm on a hinge: the arm and the spin are free. Its axis stays in
// the world, or nutates with I3/I1 w there; the arm's frame sees both turn back by W.
TEST(ModesOfSteadyMotion, ARotorOnATurningArmIsSeenFromTheArm) {
  const double W = 4, w = 54;
  const auto arm = [&](const char* joint, const char* inertia) {
    return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
      "bodies": {{"arm": {{"type": "rigid_body", "mass": 5, "inertia": [0.1, 0.4, 0.45], "position": [0.5, 0, 0],
                           "velocity": [0, {0}, 0], "angular_velocity": [0, 0, {1}],
                           "markers": {{"hub": [-0.5, 0, 0], "end": [0.5, 0, 0]}}}},
                  "rotor": {{"type": "rigid_body", "mass": 1, "inertia": {2}, "position": [1, 0, 0], "velocity": [0, {1}, 0],
                             "angular_velocity": [0, 0, {3}]}}}},
      "joints": {{"hub": {{"type": "revolute", "between": ["ground", "arm.hub"]}},
                  "rotor": {{"type": "{4}", "between": ["arm.end", "rotor.com"]}}}}, "simulate": {{"until": 1}}}})",
                       W / 2, W, inertia, w, joint);
  };
  const Modes ball = modes_of(arm("spherical", "[0.02, 0.02, 0.03]"), {}, steady());
  ASSERT_EQ(ball.oscillations().size(), 2u);
  EXPECT_NEAR(ball.oscillations()[0], W, close * w);
  EXPECT_NEAR(ball.oscillations()[1], 1.5 * w - W, close * w);
  EXPECT_EQ(ball.result["unstable"], 0);
  // On an axle along the arm's own axis nothing is left but both turns, whatever the rotor's symmetry.
  for (const char* inertia : {"[0.02, 0.02, 0.03]", "[0.02, 0.025, 0.03]"})
    EXPECT_THAT(modes_of(arm("revolute", inertia), {}, steady()).kinds(), testing::Each("zero")) << inertia;
  EXPECT_THAT(failure_of(arm("spherical", "[0.02, 0.025, 0.03]")), HasSubstr("coefficients that change with time"));
}

// A mass on a rod at the end of an arm of length R that turns at W: it lags with W sqrt(R/l) and flaps with W sqrt(1 +
// R/l).
TEST(ModesOfSteadyMotion, APendulumOnATurningArmLagsAndFlaps) {
  for (const double W : {3.0, 40.0})
    for (const double R : {0.3, 2.0}) {
      const double l = 0.7;
      const Modes modes = modes_of(fmt::format(R"({{"trammel": 1, "space": "spatial",
        "bodies": {{"arm": {{"type": "moving_base", "angle": "={0:.17g}*t", "axis": [0, 0, 1], "markers": {{"end": [{1}, 0, 0]}}}},
                    "mass": {{"type": "point_mass", "mass": 0.4, "position": [{2:.17g}, 0, 0],
                              "velocity": [0, {3:.17g}, 0]}}}},
        "joints": {{"rod": {{"type": "distance", "between": ["arm.end", "mass.point"], "length": {4}}}}},
        "simulate": {{"until": 1}}}})",
                                               W, R, R + l, W * (R + l), l),
                                   {}, steady());
      const std::vector<double> found = modes.oscillations();
      ASSERT_EQ(found.size(), 2u) << W << " " << R;
      EXPECT_NEAR(found[0], W * std::sqrt(R / l), close * W);
      EXPECT_NEAR(found[1], W * std::sqrt(1 + R / l), close * W);
      EXPECT_NEAR(modes.result["frame_rate"][2], W, 1e-9 * W);
    }
}

// Two equal masses on two equal rods that turn about a hinge, in the plane without weight: M [2 1; 1 1], K = W^2 [1 -1;
// -1 1] of the rods' angles, so sqrt(5) W beside the turn itself.
TEST(ModesOfSteadyMotion, ATurningChainSwingsAboutItsLine) {
  for (const double W : {1.0, 12.0}) {
    const Modes modes = modes_of(fmt::format(R"({{"trammel": 1, "space": "planar",
      "bodies": {{"a": {{"type": "point_mass", "mass": 1, "position": [0.6, 0.8], "velocity": ["=-0.8*{0}", "=0.6*{0}"]}},
                  "b": {{"type": "point_mass", "mass": 1, "position": [1.2, 1.6], "velocity": ["=-1.6*{0}", "=1.2*{0}"]}}}},
      "joints": {{"first": {{"type": "distance", "between": ["ground", "a.point"], "length": 1}},
                  "second": {{"type": "distance", "between": ["a.point", "b.point"], "length": 1}}}},
      "simulate": {{"until": 1}}}})",
                                             W),
                                 {}, steady());
    EXPECT_EQ(modes.kind(0), "zero");
    ASSERT_EQ(modes.oscillations().size(), 1u);
    EXPECT_NEAR(modes.oscillations()[0], std::sqrt(5) * W, close * W);
  }
}

// Two masses joined by a spring that turns: the start is not stretched, the steady motion is. At W the length is k
// l0/(k - m W^2/2), and it breathes with w^2 = 2 k/m + 3 W^2 at constant momentum.
TEST(ModesOfSteadyMotion, ATurningSpringIsStretchedFirst) {
  const double k = 300, m = 1, W = 5, l0 = 1;
  const Modes modes = modes_of(fmt::format(R"({{"trammel": 1, "space": "planar",
    "bodies": {{"a": {{"type": "rigid_body", "mass": {1}, "inertia": 0.1, "position": [-0.5, 0], "velocity": [0, "=-0.5*{0}"],
                       "angular_velocity": {0}}},
                "b": {{"type": "rigid_body", "mass": {1}, "inertia": 0.1, "position": [0.5, 0], "velocity": [0, "=0.5*{0}"],
                       "angular_velocity": {0}}}}},
    "forces": {{"spring": {{"type": "spring_damper", "between": ["a.com", "b.com"], "stiffness": {2}, "length": {3}}}}},
    "simulate": {{"until": 1}}}})",
                                           W, m, k, l0),
                               {}, steady());
  const double breath = std::sqrt(2 * k / m + 3 * W * W);
  const std::vector<double> found = modes.oscillations();
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.back(), breath, 1e-6 * breath);
}

// Two discs on one axle, joined by a spring and damper between their rims, which turns with them: its length depends
// on the angle between the discs alone, dl/dangle = R cos(angle/2), so the rate of turning does not change their
// torsion.
TEST(ModesOfSteadyMotion, ADamperThatTurnsWithItsDiscsDampsTheirTorsionAsAtRest) {
  const double I1 = 0.3, I2 = 0.5, R = 0.2, angle = 1.1, k = 400, c = 3;
  const double arm = R * std::cos(angle / 2), reduced = I1 * I2 / (I1 + I2);
  const std::complex<double> expected(-c * arm * arm / (2 * reduced),
                                      std::sqrt(k * arm * arm / reduced - std::pow(c * arm * arm / (2 * reduced), 2)));
  for (const double W : {0.0, 2.0, 50.0}) {
    const Modes modes =
        modes_of(fmt::format(R"({{"trammel": 1, "space": "planar",
      "bodies": {{"hub": {{"type": "rigid_body", "mass": 1, "inertia": {0}, "angular_velocity": {2},
                           "markers": {{"rim": [{3}, 0]}}}},
                  "ring": {{"type": "rigid_body", "mass": 1, "inertia": {1}, "angular_velocity": {2},
                            "markers": {{"rim": [{4:.17g}, {5:.17g}]}}}}}},
      "joints": {{"hub": {{"type": "revolute", "between": ["ground", "hub.com"]}},
                  "ring": {{"type": "revolute", "between": ["ground", "ring.com"]}}}},
      "forces": {{"coupling": {{"type": "spring_damper", "between": ["hub.rim", "ring.rim"], "stiffness": {6},
                                "damping": {7}, "length": {8:.17g}}}}},
      "simulate": {{"until": 1}}}})",
                             I1, I2, W, R, R * std::cos(angle), R * std::sin(angle), k, c, 2 * R * std::sin(angle / 2)),
                 {}, steady());
    int torsions = 0;
    for (std::size_t i = 0; i < modes.count(); ++i) {
      const auto& value = modes.result["modes"][i]["eigenvalue"];
      const std::complex<double> found(value["real"], std::abs(double(value["imaginary"])));
      if (found.imag() < 1) continue;
      ++torsions;
      EXPECT_LT(std::abs(found - expected), close * std::max(1.0, W) * std::abs(expected)) << W << ": " << found;
    }
    EXPECT_EQ(torsions, 1) << W;
  }
}

}  // namespace
}  // namespace trammel::test
