// The planar rigid body, beyond the checks of tests/plugins/shipped_components.cpp.
#include <gtest/gtest.h>
#include <trammel/body.hpp>

#include "../plugins/made.hpp"

namespace trammel::test {
namespace {

using Eigen::Vector3d;

const char* const bar = R"({"type": "rigid_body", "mass": 2, "inertia": 0.3,
  "position": [1, -0.5], "angle": 0.4, "velocity": [0.2, 3], "angular_velocity": -1.5,
  "markers": {"hinge": [-0.6, 0], "tip": [0.6, 0.1]}})";

Motion motion(const Body& body, int marker, const Vec& q, const Vec& v) {
  Motion m;
  body.motion(marker, 0, q, v, m);
  return m;
}

class RigidBody : public testing::Test {
 protected:
  const std::unique_ptr<Body> body = made<Body>(Kind::body, bar);
  const Vec q = Vector3d(0.3, -0.8, 2.1), v = Vector3d(-1.2, 0.7, 3.4);
};

TEST_F(RigidBody, StartsAsTheSceneSays) {
  Vec q_0(3), v_0(3);
  body->initial(q_0, v_0);
  EXPECT_EQ(q_0, Vector3d(1, -0.5, 0.4));
  EXPECT_EQ(v_0, Vector3d(0.2, 3, -1.5));
}

TEST_F(RigidBody, OffersItsCentreOfMassAndTheNamedMarkers) {
  const auto names = body->markers();
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.end()), (std::vector<std::string>{"com", "hinge", "tip"}));
  EXPECT_EQ(motion(*body, 0, q, v).x, q.head<2>());
}

TEST_F(RigidBody, HasAMassThatNeverChanges) {
  EXPECT_TRUE(body->mass_is_constant());
  Mat M = Mat::Zero(3, 3);
  Matrix into = Matrix::onto(M);
  body->mass(0, q, into);
  EXPECT_EQ(Vec(M.diagonal()), Vector3d(2, 2, 0.3));
}

TEST_F(RigidBody, ObservesItsAngleAndAngularVelocity) {
  const auto& observed = dynamic_cast<const Observed&>(*body);
  ASSERT_EQ(observed.observables().size(), 2u);
  EXPECT_EQ(observed.observables()[0], "angle");
  EXPECT_EQ(observed.observe(0, 0, q, v), 2.1);
  EXPECT_EQ(observed.observables()[1], "angular_velocity");
  EXPECT_EQ(observed.observe(1, 0, q, v), 3.4);
}

TEST_F(RigidBody, IsDrawnAsSpokesFromItsCentreOfMassToItsMarkers) {
  Mat points;
  dynamic_cast<const Drawn&>(*body).shape(0, q, points);
  ASSERT_EQ(points.cols(), 5);
  EXPECT_EQ(points.col(0), q.head<2>());
  EXPECT_EQ(points.col(1), Vec(motion(*body, 1, q, v).x));
  EXPECT_EQ(points.col(2), q.head<2>());
  EXPECT_EQ(points.col(3), Vec(motion(*body, 2, q, v).x));
}

TEST(RigidBodyInput, IsRefusedWithAReason) {
  const auto refused = [](const char* entry, const char* reason, const World& world = planar()) {
    const std::string text = refusal(Kind::body, entry, world);
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1})", "this scene is spatial", spatial());
  refused(R"({"type": "rigid_body", "inertia": 1})", "mass");
  refused(R"({"type": "rigid_body", "mass": 0, "inertia": 1})", "mass");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": -1})", "inertia");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1, "markers": {"com": [1, 0]}})", "built in");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1, "markers": {"tip": [1, 0, 0]}})", "markers.tip");
}

}  // namespace
}  // namespace trammel::test
