// The rigid body, planar and spatial, beyond the checks of tests/plugins/shipped_components.cpp.
#include <algorithm>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <trammel/body.hpp>

#include "model/coordinates.hpp"

#include "support/made.hpp"

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

Mat mass(const Body& body, const Vec& q) {
  Mat M = Mat::Zero(body.coordinates().nv(), body.coordinates().nv());
  Matrix into = Matrix::onto(M);
  body.mass(0, q, into);
  return M;
}

Vec acceleration(const Body& body, const Vec& q, const Vec& v) {
  Vec f = Vec::Zero(v.size());
  body.force(0, q, v, f);
  return mass(body, q).ldlt().solve(f);
}

// q moved by the increments dq.
Vec moved(const Body& body, const Vec& q, const Vec& dq) {
  const Coordinates coordinates = body.coordinates();
  Vec to = q;
  Eigen::Index iq = 0, iv = 0;
  for (const Coordinates::Part& part : coordinates.parts()) {
    model::retract(part, q.data() + iq, dq.data() + iv, to.data() + iq);
    iq += part.nq, iv += part.nv;
  }
  return to;
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
  EXPECT_EQ(mass(*body, q), mass(*body, 2 * q));
  EXPECT_EQ(Vec(mass(*body, q).diagonal()), Vector3d(2, 2, 0.3));
}

TEST_F(RigidBody, ObservesItsAngleAndAngularVelocity) {
  const auto& observed = dynamic_cast<const Observed&>(*body);
  ASSERT_EQ(observed.observables().size(), 5u);
  EXPECT_EQ(observed.observables()[0], "angle");
  EXPECT_EQ(observed.observe(0, 0, q, v), 2.1);
  EXPECT_EQ(observed.observables()[1], "angular_velocity");
  EXPECT_EQ(observed.observe(1, 0, q, v), 3.4);
}

TEST_F(RigidBody, ObservesItsMomenta) {
  const auto& observed = dynamic_cast<const Observed&>(*body);
  EXPECT_EQ(observed.observables()[2], "momentum_x");
  EXPECT_DOUBLE_EQ(observed.observe(2, 0, q, v), 2 * -1.2);
  EXPECT_DOUBLE_EQ(observed.observe(3, 0, q, v), 2 * 0.7);
  EXPECT_EQ(observed.observables()[4], "angular_momentum");
  EXPECT_DOUBLE_EQ(observed.observe(4, 0, q, v), 0.3 * 3.4 + 2 * (0.3 * 0.7 - -0.8 * -1.2));
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
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1})", "the scene is spatial", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": [1, 1, 1]})", "the scene is planar");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": [1, 1, 2.1]})", "may not exceed the sum", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": [1, 1, 1, 2, 0, 0]})", "least principal moment", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": [0, 0, 0]})", "least principal moment", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "box": [1, 2]})", "3 lengths", spatial());
  refused(R"({"type": "rigid_body", "density": 1, "inertia": [1, 1, 1]})", "needs a shape", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "density": 1, "sphere": {"radius": 1}})", "not both", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": [1, 1, 1], "sphere": {"radius": 1}})", "remove one",
          spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "box": [1, 1, 1], "sphere": {"radius": 1}})", "one shape", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "cylinder": {"radius": 1}})", "a radius and a length", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "sphere": {"radius": 1}, "orientation": [0, 0, 0, 0]})",
          "quaternion is zero", spatial());
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1, "axis": [0, 1]})", "axis");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1, "angular_velocity": [1, 2, 3]})", "found 3 numbers");
  refused(R"({"type": "rigid_body", "inertia": 1})", "mass");
  refused(R"({"type": "rigid_body", "mass": 0, "inertia": 1})", "mass");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": -1})", "inertia");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1, "markers": {"com": [1, 0]}})", "built in");
  refused(R"({"type": "rigid_body", "mass": 1, "inertia": 1, "markers": {"tip": [1, 0, 0]}})", "markers.tip");
}

const char* const brick = R"({"type": "rigid_body", "mass": 2, "inertia": [0.3, 0.5, 0.4, 0.05, -0.1, 0.02],
  "position": [1, -0.5, 0.2], "axis": [0, 0, 2], "angle": 0.4, "velocity": [0.2, 3, -1], "angular_velocity": [1, -2, 0.5],
  "markers": {"hinge": [-0.6, 0, 0.1], "tip": [0.6, 0.1, -0.3]}})";

Vec spatial_state(std::initializer_list<double> x) {
  return Eigen::Map<const Vec>(x.begin(), Eigen::Index(x.size()));
}

class SpatialRigidBody : public testing::Test {
 protected:
  const std::unique_ptr<Body> body = made<Body>(Kind::body, brick, spatial());
  const Vec q = spatial_state({0.3, -0.8, 2.1, 0.5, 0.7, -0.1, 0.5}),
            v = spatial_state({-1.2, 0.7, 3.4, 2.1, -1.3, 0.8});
};

TEST_F(SpatialRigidBody, StartsAsTheSceneSays) {
  Vec q_0(7), v_0(6);
  body->initial(q_0, v_0);
  EXPECT_LT((q_0 - spatial_state({1, -0.5, 0.2, std::cos(0.2), 0, 0, std::sin(0.2)})).norm(), 1e-15);
  EXPECT_EQ(v_0, spatial_state({0.2, 3, -1, 1, -2, 0.5}));
}

TEST_F(SpatialRigidBody, MomentaAreThoseOfItsForces) {
  // Free except for gravity: p' = m g, L' = x x m g about the origin.
  const auto& observed = dynamic_cast<const Observed&>(*body);
  const auto names = observed.observables();
  const auto momentum = [&](double t, const char* name) {
    const Vec a = acceleration(*body, q, v);
    const auto found = std::find(names.begin(), names.end(), name);
    return observed.observe(int(found - names.begin()), 0, moved(*body, q, t * v + t * t / 2 * a), v + t * a);
  };
  const Eigen::Vector3d weight(0, 0, -2 * 9.81), moment = Eigen::Vector3d(q.head<3>()).cross(weight);
  const char* const linear[] = {"momentum_x", "momentum_y", "momentum_z"};
  const char* const angular[] = {"angular_momentum_x", "angular_momentum_y", "angular_momentum_z"};
  for (int i = 0; i < 3; ++i) {
    const double h = 1e-4;  // central differences: h^2 times third derivatives of order 100
    EXPECT_NEAR((momentum(h, linear[i]) - momentum(-h, linear[i])) / (2 * h), weight(i), 1e-6);
    EXPECT_NEAR((momentum(h, angular[i]) - momentum(-h, angular[i])) / (2 * h), moment(i), 1e-6);
  }
}

TEST(RigidBodyShapes, HaveTheInertiaOfTheTextbook) {
  const auto inertia = [](const char* entry, const World& world) {
    const auto body = made<Body>(Kind::body, entry, world);
    Vec q(body->coordinates().nq()), v(body->coordinates().nv());
    body->initial(q, v);
    return Vec(mass(*body, q).diagonal());
  };
  EXPECT_LT((inertia(R"({"type": "rigid_body", "density": 500, "box": [1, 0.2, 0.1]})", spatial()) -
             spatial_state({10, 10, 10, 10 * 0.05 / 12, 10 * 1.01 / 12, 10 * 1.04 / 12}))
                .norm(),
            1e-14);
  EXPECT_LT((inertia(R"({"type": "rigid_body", "mass": 3, "cylinder": {"radius": 0.2, "length": 1, "axis": "x"}})",
                     spatial()) -
             spatial_state({3, 3, 3, 0.06, 3 * 1.12 / 12, 3 * 1.12 / 12}))
                .norm(),
            1e-14);
  EXPECT_LT((inertia(R"({"type": "rigid_body", "density": 7, "sphere": {"radius": 0.5}})", planar()) -
             spatial_state({7 * EIGEN_PI / 6, 7 * EIGEN_PI / 6, 0.1 * 7 * EIGEN_PI / 6}))
                .norm(),
            1e-14);
}

}  // namespace
}  // namespace trammel::test
