// What single forces promise beyond the checks of shipped_components.cpp: signs, laws of time, refusals.
#include <gtest/gtest.h>
#include <trammel/force.hpp>
#include <trammel/testing/markers.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

struct Wrenches {
  Wrench on_A, on_B;
};

const MovingPair pair = moving_pair(Space::planar), spatial_pair = moving_pair(Space::spatial);

Wrenches wrenches(const Force& force, double t, const Motion& A, const Motion& B) {
  Wrenches w{Wrench::Zero(A.V.size()), Wrench::Zero(B.V.size())};
  force.wrench(t, A, B, w.on_A, w.on_B);
  return w;
}

TEST(SpringDamper, PullsItsMarkersTogetherWhenStretched) {
  const auto spring = made<Force>(Kind::force, R"({"type": "spring_damper", "stiffness": 10, "length": 1})");
  const Wrenches w =
      wrenches(*spring, 0, marker_at(Vec::Zero(3), Vec::Zero(3)), marker_at(3 * Vec::Unit(3, 0), Vec::Zero(3)));
  EXPECT_DOUBLE_EQ(w.on_A(0), 20);
  EXPECT_DOUBLE_EQ(w.on_B(0), -20);
}

TEST(SpringDamper, HasNoDirectionWhereItsMarkersCoincide) {
  const Motion at_origin = marker_at(Vec::Zero(3), Vec::Zero(3));
  const auto with_length = made<Force>(Kind::force, R"({"type": "spring_damper", "stiffness": 10, "length": 1})");
  const auto without = made<Force>(Kind::force, R"({"type": "spring_damper", "stiffness": 10, "length": 0})");
  EXPECT_THROW(wrenches(*with_length, 0, at_origin, at_origin), std::domain_error);
  EXPECT_EQ(wrenches(*without, 0, at_origin, at_origin).on_A.norm(), 0);
}

TEST(TorsionalSpring, CountsFullTurns) {
  const auto spring = made<Force>(Kind::force, R"({"type": "torsional_spring", "stiffness": 2})");
  const double turns = 6 * EIGEN_PI;
  const Wrenches w =
      wrenches(*spring, 0, marker_at(Vec::Zero(3), Vec::Zero(3)), marker_at(turns * Vec::Unit(3, 2), Vec::Zero(3)));
  EXPECT_DOUBLE_EQ(w.on_B(2), -2 * turns);
}

TEST(TorsionalSpring, TurnsAboutItsAxisInSpace) {
  const auto spring =
      made<Force>(Kind::force, R"({"type": "torsional_spring", "stiffness": 2, "axis": [0, 3, 0]})", spatial());
  const Wrenches w =
      wrenches(*spring, 0, marker_at(Vec::Zero(6), Vec::Zero(6)), marker_at(0.4 * Vec::Unit(6, 4), Vec::Zero(6)));
  EXPECT_LT((w.on_B.tail<3>() + 0.8 * Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Drive, HasItsStallMomentAtRestAndNoneAtItsFreeSpeed) {
  const auto drive = made<Force>(Kind::force, R"({"type": "drive", "stall": 4, "free_speed": 30})");
  const auto moment = [&](double speed) {
    return wrenches(*drive, 0, marker_at(Vec::Zero(3), Vec::Zero(3)), marker_at(Vec::Zero(3), speed * Vec::Unit(3, 2)))
        .on_B(2);
  };
  EXPECT_DOUBLE_EQ(moment(0), 4);
  EXPECT_DOUBLE_EQ(moment(15), 2);
  EXPECT_DOUBLE_EQ(moment(30), 0);
}

TEST(Load, FollowsItsLawsOfTimeInWorldAxes) {
  const auto load =
      made<Force>(Kind::force, R"({"type": "load", "force": {"x": "=3*t", "y": -2}, "moment": "=cos(t)*1"})");
  const Wrenches w = wrenches(*load, 0.5, pair.a.at(0), pair.b.at(0));
  EXPECT_DOUBLE_EQ(w.on_B(0), 1.5);
  EXPECT_DOUBLE_EQ(w.on_B(1), -2);
  EXPECT_DOUBLE_EQ(w.on_B(2), std::cos(0.5));
  EXPECT_EQ(w.on_A.norm(), 0);
}

TEST(Load, TurnsWithTheMarkerInBodyAxes) {
  const auto load = made<Force>(Kind::force, R"({"type": "load", "force": {"x": 5}, "frame": "body"})");
  const Motion turned = marker_at(0.3 * Vec::Unit(3, 2), Vec::Zero(3));
  const Wrenches w = wrenches(*load, 0, pair.a.at(0), turned);
  EXPECT_DOUBLE_EQ(w.on_B(0), 5 * std::cos(0.3));
  EXPECT_DOUBLE_EQ(w.on_B(1), 5 * std::sin(0.3));
}

TEST(Load, SuppliesThePowerOfItsWrench) {
  const auto load = made<Force>(Kind::force, R"({"type": "load", "force": {"x": 2, "y": "=t"}, "moment": 3})");
  const Motion B = marker_at(Vec::Zero(3), Eigen::Vector3d(5, 7, 11));
  const Power power = load->power(2, pair.a.at(0), B);
  EXPECT_DOUBLE_EQ(power.supplied, 2 * 5 + 2 * 7 + 3 * 11);
  EXPECT_EQ(power.dissipated, 0);
}

TEST(Load, ActsInSpace) {
  const auto load = made<Force>(Kind::force, R"({"type": "load", "force": {"x": 1, "z": "=-4*t"}})", spatial());
  const Wrenches w = wrenches(*load, 0.5, spatial_pair.a.at(0), spatial_pair.b.at(0));
  EXPECT_EQ(w.on_B, (Vec6(6) << 1, 0, -2, 0, 0, 0).finished());
}

TEST(Forces, RefuseWhatTheyCannotDo) {
  const auto refused = [](const char* entry, const World& world, const char* reason) {
    EXPECT_NE(refusal(Kind::force, entry, world).find(reason), std::string::npos) << refusal(Kind::force, entry, world);
  };
  refused(R"({"type": "torsional_spring", "stiffness": 1, "axis": [0, 1]})", planar(), "this scene is planar");
  refused(R"({"type": "bushing"})", planar(), "give stiffness");
  refused(R"({"type": "bushing", "torsional_stiffness": 1})", spatial(), "expected three numbers");
  refused(R"({"type": "drive", "stall": 1})", planar(), "free_speed");
  refused(R"({"type": "load", "torque": {"x": 1}})", planar(), "this scene is planar");
  refused(R"({"type": "torsional_spring"})", planar(), "give stiffness, damping or both");
  refused(R"({"type": "spring_damper"})", planar(), "give stiffness, damping or both");
  refused(R"({"type": "spring_damper", "stiffness": 5})", planar(), "needs its rest length");
  refused(R"({"type": "load", "force": {"z": 1}})", planar(), "this scene is planar");
  refused(R"({"type": "load", "moment": 1})", spatial(), "this scene is spatial");
}

}  // namespace
}  // namespace trammel::test
