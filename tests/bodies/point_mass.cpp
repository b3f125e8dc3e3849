// The point mass, in the plane and in space, beyond the checks of tests/plugins/shipped_components.cpp.
#include <gtest/gtest.h>
#include <trammel/body.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

Motion motion(const Body& body, int marker, const Vec& q, const Vec& v) {
  Motion m;
  body.motion(marker, 0, q, v, m);
  return m;
}

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
TEST_P(PointMass, StartsAtRestAtTheOriginByDefault) {
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
