// Contacts with friction in space: the cone's own conditions, whatever the number of contacts and however redundant
// they are.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "complementarity/contact_forces.hpp"
#include "complementarity/programs/friction_cone.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;
using Eigen::Vector2d;

struct Scene {
  std::vector<ContactPoint> points;
  Mat A;
  Vec b;
};

// n feet with normals and two tangents each, on a system of `dofs` velocities.
Scene random_feet(std::mt19937& random, int n, int dofs, double mu) {
  std::normal_distribution<double> normal;
  Scene scene;
  const Mat G = Mat::NullaryExpr(3 * n, dofs, [&] { return normal(random); });
  scene.A = G * G.transpose();
  // What some acceleration of the system does to them: consistent where rows depend on each other. It presses them.
  Vec a = Vec::NullaryExpr(dofs, [&] { return normal(random); });
  for (int i = 0; i < n; ++i) a -= 0.6 * G.row(3 * i).transpose();
  scene.b = G * a;
  for (int i = 0; i < n; ++i)
    scene.points.push_back(
        {.normal = 3 * i, .tangent = 3 * i + 1, .tangents = 2, .kind = Tangent::resting, .coefficient = mu});
  return scene;
}

// The largest violation of the conditions, relative to the forces and accelerations.
double violation(const Scene& scene, const Vec& F, const Vec& a) {
  const double f = F.lpNorm<Eigen::Infinity>() + 1e-300, size = scene.b.lpNorm<Eigen::Infinity>();
  double worst = (scene.A * F + scene.b - a).lpNorm<Eigen::Infinity>() / size;
  for (const ContactPoint& p : scene.points) {
    double N = p.given;
    if (p.normal >= 0) {
      N = F[p.normal];
      worst = std::max({worst, -N / f, -a[p.normal] / size, N > 0 ? std::abs(a[p.normal]) / size : 0});
    }
    const Vector2d T = F.segment(p.tangent, 2), s = a.segment(p.tangent, 2);
    worst = std::max(worst, (T.norm() - p.coefficient * N) / f);
    worst = std::max(worst, (s.norm() * T + p.coefficient * N * s).norm() / (f * size));
  }
  return worst;
}

TEST(FrictionCone, HoldsForRandomFeet) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const int n = 1 + i % 4;
    const Scene scene = random_feet(random, n, 3 * n + 2, 0.3);
    Vec F, a;
    ASSERT_EQ(solve_contacts(scene.points, scene.A, scene.b, F, a).outcome, LcpOutcome::solved) << i;
    EXPECT_LT(violation(scene, F, a), 1e-11) << i;
  }
}

// Four feet of a rigid body of 1 kg, gyration radius 0.5 m, and any forces on it: twelve rows, six velocities, F is one
// of many.
Scene random_table(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Mat G(12, 6);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d r(normal(random), normal(random), -0.2);
    const Eigen::Vector3d axes[] = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
    for (int k = 0; k < 3; ++k) G.row(3 * i + k) << axes[k].transpose(), r.cross(axes[k]).transpose() / 0.5;
  }
  Vec a = Vec::NullaryExpr(6, [&] { return 2 * normal(random); });
  a[2] -= 9.81;
  Scene scene{.points = {}, .A = G * G.transpose(), .b = G * a};
  for (int i = 0; i < 4; ++i)
    scene.points.push_back(
        {.normal = 3 * i, .tangent = 3 * i + 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.3});
  return scene;
}

TEST(FrictionCone, HoldsForRedundantFeet) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = random_table(random);
    Vec F, a;
    ASSERT_EQ(solve_contacts(scene.points, scene.A, scene.b, F, a).outcome, LcpOutcome::solved) << i;
    EXPECT_LT(violation(scene, F, a), 1e-9) << i;
  }
}

// Normal forces given, the problem is that of the least of T.A T/2 + b.T on the disks, and always has a solution.
TEST(FrictionCone, HoldsUnderGivenForcesWhateverTheCoefficient) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 3);
  for (int i = 0; i < 200; ++i) {
    const int n = 1 + i % 5, dofs = i % 3 ? 2 * n : 3;
    std::normal_distribution<double> normal;
    Scene scene;
    const Mat G = Mat::NullaryExpr(2 * n, dofs, [&] { return normal(random); });
    scene.A = G * G.transpose();
    scene.b = G * Vec::NullaryExpr(dofs, [&] { return normal(random); });
    for (int k = 0; k < n; ++k)
      scene.points.push_back({.tangent = 2 * k,
                              .tangents = 2,
                              .kind = Tangent::resting,
                              .coefficient = uniform(random),
                              .given = uniform(random)});
    Vec F, a;
    ASSERT_EQ(solve_contacts(scene.points, scene.A, scene.b, F, a).outcome, LcpOutcome::solved) << i;
    EXPECT_LT(violation(scene, F, a), 1e-9) << i;
  }
}

TEST(FrictionCone, PushedAlongOneTangentIsTheCaseOfThePlane) {
  const Mat A = Eigen::Vector3d(2, 3, 3).asDiagonal();
  const Vec b = Eigen::Vector3d(-10, 9, 0);
  const std::vector<ContactPoint> cone{
      {.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.5}};
  const std::vector<ContactPoint> plane{{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 0.5}};
  Vec F, a, F_plane, a_plane;
  ASSERT_EQ(solve_contacts(cone, A, b, F, a).outcome, LcpOutcome::solved);
  ASSERT_EQ(solve_contacts(plane, A.topLeftCorner(2, 2), b.head(2), F_plane, a_plane).outcome, LcpOutcome::solved);
  EXPECT_LT((F.head(2) - F_plane).norm() + std::abs(F[2]), 1e-14);
  EXPECT_LT((a.head(2) - a_plane).norm() + std::abs(a[2]), 1e-14);
}

// Isotropic: whatever the direction of the push, the force is on the circle and not on a pyramid around it.
TEST(FrictionCone, IsRound) {
  const Mat A = Eigen::Vector3d(2, 3, 3).asDiagonal();
  const std::vector<ContactPoint> point{
      {.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.5}};
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    const Vector2d e(std::cos(angle), std::sin(angle));
    Vec F, a;
    ASSERT_EQ(solve_contacts(point, A, (Vec(3) << -10, 9 * e).finished(), F, a).outcome, LcpOutcome::solved);
    EXPECT_LT((F.tail(2) + 2.5 * e).norm(), 1e-12);  // it ends at 1e-14 of the forces, which A makes 10 times as much
    EXPECT_LT((a.tail(2) - 1.5 * e).norm(), 1e-12);
  }
}

TEST(FrictionCone, AForceExactlyOnItsBoundLeavesNoAcceleration) {
  const Mat A = Eigen::Vector3d(2, 3, 3).asDiagonal();
  const std::vector<ContactPoint> point{
      {.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.5}};
  Vec F, a;
  ASSERT_EQ(solve_contacts(point, A, (Vec(3) << -10, 4.5, 6).finished(), F, a).outcome, LcpOutcome::solved);
  EXPECT_LT((F.tail(2) - Vector2d(-1.5, -2)).norm(), 1e-14);
  EXPECT_LT(a.tail(2).norm(), 1e-14);
}

// A third of the contacts slides, some have no friction or a given normal force.
Problem any_cones(std::mt19937& random, int number) {
  RandomKinds kinds;
  kinds.contacts = 1 + number % 4, kinds.velocities = 3 * kinds.contacts + 2, kinds.most_friction = 0.5;
  Problem problem = random_spatial(random, kinds);
  const double accelerations = std::pow(10.0, number % 5 * 3 - 6), forces = std::pow(10.0, number % 3 * 4 - 4);
  problem.A *= accelerations / forces, problem.b *= accelerations;
  for (ContactPoint& p : problem.points) p.given *= forces;
  return problem;
}

// From no forces, from near ones and from any, in whatever units; without sweeps, which follow only if Newton's method
// ends without a solution.
TEST(FrictionCone, IsReachedByNewtonsMethodAlone) {
  std::mt19937 random(83);
  std::normal_distribution<double> normal;
  int attempts = 0, reached = 0;
  for (int i = 0; i < 300; ++i) {
    const Problem problem = any_cones(random, i);
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    const double size = answer.F.lpNorm<Eigen::Infinity>();
    const Vec other = size * Vec::NullaryExpr(problem.b.size(), [&] { return normal(random); });
    for (Vec F : {Vec(0 * other), Vec(answer.F + 1e-3 * other), Vec(1e3 * other)}) {
      ++attempts;
      if (!solve_cones(problem.points, problem.A, problem.b, F, 1)) continue;
      ++reached;
      EXPECT_LE(violation(problem.points, problem.A, problem.b, F), 1e-10) << i;
    }
  }
  EXPECT_GE(reached, attempts - 5);  // it may meet a step that it cannot shorten
}

TEST(FrictionCone, IsNotReachedWhereThereAreNoForces) {
  ContactPoint slides{.normal = 0, .tangent = 1, .kind = Tangent::sliding};
  slides.ratio[0] = -3;  // a_n = -N - 10
  Vec F = Vec::Zero(2);
  EXPECT_FALSE(solve_cones({slides}, Mat{{2, 1}, {1, 3}}, Vec{{-10, 0}}, F, 3));
  const std::vector<ContactPoint> foot{{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 0.5}};
  const Mat A{{2, 0}, {0, 3}};
  F = Vec{{5, -2}};
  EXPECT_FALSE(solve_cones(foot, A, Vec{{-10, 6}}, F, 0)) << "no rounds";
  EXPECT_TRUE(solve_cones(foot, A, Vec{{-10, 6}}, F, 1));
  EXPECT_FALSE(solve_cones(foot, A, Vec{{std::nan(""), 6}}, F, 1));
}

}  // namespace
}  // namespace trammel::complementarity
