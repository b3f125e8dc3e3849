// What every force owes: minus the gradient of its potential, a power balance, and action equal to reaction.
#include <gtest/gtest.h>
#include <trammel/force.hpp>

#include "../made.hpp"
#include "../moving_marker.hpp"

namespace trammel::test {
namespace {

struct Case {
  const char* name;
  const char* entry;
  Space space = Space::planar;
};

const Case cases[] = {
    {"spring", R"({"type": "spring_damper", "stiffness": 40, "length": 0.7})"},
    {"spring_damper", R"({"type": "spring_damper", "stiffness": 40, "damping": 3, "length": 0.7})"},
    {"damper", R"({"type": "spring_damper", "damping": 3})"},
    {"spring_damper_spatial", R"({"type": "spring_damper", "stiffness": 40, "damping": 3, "length": 0.7})",
     Space::spatial},
    {"torsional_spring", R"({"type": "torsional_spring", "stiffness": 12, "damping": 0.8, "angle": 0.4})"},
};

struct Wrenches {
  Wrench on_A, on_B;
};

Wrenches wrenches(const Force& force, double t, const Motion& A, const Motion& B) {
  Wrenches w{Wrench::Zero(A.V.size()), Wrench::Zero(B.V.size())};
  force.wrench(t, A, B, w.on_A, w.on_B);
  return w;
}

class ForceBalance : public testing::TestWithParam<Case> {
 protected:
  const Space space = GetParam().space;
  const std::unique_ptr<Force> force =
      made<Force>(Kind::force, GetParam().entry, space == Space::planar ? planar() : spatial());
  const MovingMarker a = space == Space::planar ? marker_a() : point_a();
  const MovingMarker b = space == Space::planar ? marker_b() : point_b();
};

TEST_P(ForceBalance, ForceAtRestIsMinusTheGradientOfThePotential) {
  const Vec q_A = Eigen::Vector3d(0.2, -0.4, 0.9), q_B = Eigen::Vector3d(1.1, 0.6, -0.3), rest = Vec::Zero(3);
  const Wrenches w = wrenches(*force, 0, a.motion(q_A, rest), b.motion(q_B, rest));
  for (int i = 0; i < 3; ++i) {
    const auto potential = [&](double step_A, double step_B) {
      return force->potential(0, a.motion(q_A + step_A * Vec::Unit(3, i), rest),
                              b.motion(q_B + step_B * Vec::Unit(3, i), rest));
    };
    // Potentials are of order ten here.
    EXPECT_NEAR(w.on_A(i), -derivative([&](double s) { return potential(s, 0); }, 0), 10 * difference_error);
    EXPECT_NEAR(w.on_B(i), -derivative([&](double s) { return potential(0, s); }, 0), 10 * difference_error);
  }
}

TEST_P(ForceBalance, WorkIsStoredOrDissipated) {
  for (double t : {0.1, 0.7, 1.9}) {
    const Motion A = a.at(t), B = b.at(t);
    const Wrenches w = wrenches(*force, t, A, B);
    const Power power = force->power(t, A, B);
    const double stored = derivative([&](double s) { return force->potential(s, a.at(s), b.at(s)); }, t);
    EXPECT_NEAR(stored + w.on_A.dot(A.V) + w.on_B.dot(B.V), power.supplied - power.dissipated, 10 * difference_error);
    EXPECT_GE(power.dissipated, 0);
  }
}

TEST_P(ForceBalance, ActionEqualsReaction) {
  const Motion A = a.at(0.7), B = b.at(0.7);
  const Wrenches w = wrenches(*force, 0.7, A, B);
  EXPECT_EQ((w.on_A + w.on_B).norm(), 0);
  const Vec3 F = w.on_B.head(A.x.size()), d = B.x - A.x;
  EXPECT_NEAR(F(0) * d(1) - F(1) * d(0), 0, 1e-12);  // along the line of the markers, round-off of forces of order 50
}

INSTANTIATE_TEST_SUITE_P(All, ForceBalance, testing::ValuesIn(cases),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(SpringDamper, PullsItsMarkersTogetherWhenStretched) {
  const auto spring = made<Force>(Kind::force, R"({"type": "spring_damper", "stiffness": 10, "length": 1})");
  const MovingMarker m = marker_a();
  const Wrenches w =
      wrenches(*spring, 0, m.motion(Vec::Zero(3), Vec::Zero(3)), m.motion(3 * Vec::Unit(3, 0), Vec::Zero(3)));
  EXPECT_DOUBLE_EQ(w.on_A(0), 20);
  EXPECT_DOUBLE_EQ(w.on_B(0), -20);
}

TEST(SpringDamper, HasNoDirectionWhereItsMarkersCoincide) {
  const Motion at_origin = marker_a().motion(Vec::Zero(3), Vec::Zero(3));
  const auto with_length = made<Force>(Kind::force, R"({"type": "spring_damper", "stiffness": 10, "length": 1})");
  const auto without = made<Force>(Kind::force, R"({"type": "spring_damper", "stiffness": 10, "length": 0})");
  EXPECT_THROW(wrenches(*with_length, 0, at_origin, at_origin), std::domain_error);
  EXPECT_EQ(wrenches(*without, 0, at_origin, at_origin).on_A.norm(), 0);
}

TEST(TorsionalSpring, CountsFullTurns) {
  const auto spring = made<Force>(Kind::force, R"({"type": "torsional_spring", "stiffness": 2})");
  const double turns = 6 * EIGEN_PI;
  const MovingMarker m = marker_a();
  const Wrenches w =
      wrenches(*spring, 0, m.motion(Vec::Zero(3), Vec::Zero(3)), m.motion(turns * Vec::Unit(3, 2), Vec::Zero(3)));
  EXPECT_DOUBLE_EQ(w.on_B(2), -2 * turns);
}

TEST(Load, FollowsItsLawsOfTimeInWorldAxes) {
  const auto load =
      made<Force>(Kind::force, R"({"type": "load", "force": {"x": "=3*t", "y": -2}, "moment": "=cos(t)*1"})");
  const Wrenches w = wrenches(*load, 0.5, marker_a().at(0), marker_b().at(0));
  EXPECT_DOUBLE_EQ(w.on_B(0), 1.5);
  EXPECT_DOUBLE_EQ(w.on_B(1), -2);
  EXPECT_DOUBLE_EQ(w.on_B(2), std::cos(0.5));
  EXPECT_EQ(w.on_A.norm(), 0);
}

TEST(Load, TurnsWithTheMarkerInBodyAxes) {
  const auto load = made<Force>(Kind::force, R"({"type": "load", "force": {"x": 5}, "frame": "body"})");
  const Motion turned = marker_b().motion(0.3 * Vec::Unit(3, 2), Vec::Zero(3));
  const Wrenches w = wrenches(*load, 0, marker_a().at(0), turned);
  EXPECT_DOUBLE_EQ(w.on_B(0), 5 * std::cos(0.3));
  EXPECT_DOUBLE_EQ(w.on_B(1), 5 * std::sin(0.3));
}

TEST(Load, SuppliesThePowerOfItsWrench) {
  const auto load = made<Force>(Kind::force, R"({"type": "load", "force": {"x": 2, "y": "=t"}, "moment": 3})");
  const Motion B = marker_b().motion(Vec::Zero(3), Eigen::Vector3d(5, 7, 11));
  const Power power = load->power(2, marker_a().at(0), B);
  EXPECT_DOUBLE_EQ(power.supplied, 2 * 5 + 2 * 7 + 3 * 11);
  EXPECT_EQ(power.dissipated, 0);
}

TEST(Load, ActsInSpace) {
  const auto load = made<Force>(Kind::force, R"({"type": "load", "force": {"x": 1, "z": "=-4*t"}})", spatial());
  const Wrenches w = wrenches(*load, 0.5, point_a().at(0), point_b().at(0));
  EXPECT_EQ(w.on_B, (Vec6(6) << 1, 0, -2, 0, 0, 0).finished());
}

TEST(Forces, RefuseWhatTheyCannotDo) {
  const auto refused = [](const char* entry, const World& world, const char* reason) {
    EXPECT_NE(refusal(Kind::force, entry, world).find(reason), std::string::npos) << refusal(Kind::force, entry, world);
  };
  refused(R"({"type": "torsional_spring", "stiffness": 1})", spatial(), "this scene is spatial");
  refused(R"({"type": "torsional_spring"})", planar(), "give stiffness, damping or both");
  refused(R"({"type": "spring_damper"})", planar(), "give stiffness, damping or both");
  refused(R"({"type": "spring_damper", "stiffness": 5})", planar(), "needs its rest length");
  refused(R"({"type": "load", "force": {"z": 1}})", planar(), "this scene is planar");
  refused(R"({"type": "load", "moment": 1})", spatial(), "this scene is spatial");
}

}  // namespace
}  // namespace trammel::test
