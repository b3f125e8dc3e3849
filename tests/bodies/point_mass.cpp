// The point mass, in the plane and in space.
#include <gtest/gtest.h>

#include "../plugins/made.hpp"
#include "body_checks.hpp"

namespace trammel::test {
namespace {

class PointMass : public testing::TestWithParam<Space> {
 protected:
  const bool plane = GetParam() == Space::planar;
  const World world = plane ? planar() : spatial();
  const std::unique_ptr<Body> body = made<Body>(Kind::body, R"({"type": "point_mass", "mass": 2.5})", world);
  const Vec q = Eigen::Vector3d(0.3, -0.8, 1.7).head(dimension(world.space));
  const Vec v = Eigen::Vector3d(-1.2, 0.7, 2.2).head(dimension(world.space));
};

TEST_P(PointMass, HasTheSceneSDimension) {
  EXPECT_EQ(body->coordinates().nq(), plane ? 2 : 3);
  EXPECT_EQ(body->coordinates().nv(), plane ? 2 : 3);
  EXPECT_EQ(motion(*body, 0, q, v).V.size(), plane ? 3 : 6);
}
TEST_P(PointMass, MarkersMoveAsTheySay) {
  expect_markers_move_as_they_say(*body, q, v);
}
TEST_P(PointMass, EnergyIsKept) {
  expect_energy_is_kept(*body, q, v);
}
TEST_P(PointMass, KineticEnergyIsThatOfItsMass) {
  expect_kinetic_energy_of_its_mass(*body, q, v);
}
TEST_P(PointMass, TangentIsExact) {
  expect_exact_tangent(*body, q, v);
}
TEST_P(PointMass, ReactionDerivativeIsExact) {
  expect_exact_reaction_derivative(*body, q, v);
}

TEST_P(PointMass, StartsAtRestAtTheOriginUnlessToldOtherwise) {
  Vec q_0 = q, v_0 = v;
  body->initial(q_0, v_0);
  EXPECT_EQ(q_0.norm(), 0);
  EXPECT_EQ(v_0.norm(), 0);
}

TEST_P(PointMass, IgnoresAMomentOnIt) {
  const Motion m = motion(*body, 0, q, v);
  EXPECT_EQ(m.J.bottomRows(rotations(world.space)).norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(Both, PointMass, testing::Values(Space::planar, Space::spatial),
                         [](const auto& test_case) { return test_case.param == Space::planar ? "planar" : "spatial"; });

TEST(PointMassInput, StartsAsTheSceneSays) {
  const auto body = made<Body>(
      Kind::body, R"({"type": "point_mass", "mass": 1, "position": [1, 2, 3], "velocity": [4, 5, 6]})", spatial());
  Vec q(3), v(3);
  body->initial(q, v);
  EXPECT_EQ(q, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(v, Eigen::Vector3d(4, 5, 6));
}

TEST(PointMassInput, IsRefusedWithAReason) {
  EXPECT_NE(refusal(Kind::body, R"({"type": "point_mass"})").find("mass"), std::string::npos);
  EXPECT_NE(refusal(Kind::body, R"({"type": "point_mass", "mass": 0})").find("mass"), std::string::npos);
  EXPECT_NE(refusal(Kind::body, R"({"type": "point_mass", "mass": 1, "position": [1, 2, 3]})").find("position"),
            std::string::npos);
}

}  // namespace
}  // namespace trammel::test
