// A box on four feet that turns about one of them: how the feet share decides its motion. They share as equal springs
// do.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "problem.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Vector3d;

// Of mass 1, a box of lengths 2 a, 2 b, 2 c. Foot 0 rests, the others slide as it turns. `load` acts at `at`.
Problem turning_box(double a, double b, double c, double mu, const Vector3d& load, const Vector3d& at) {
  const Vector3d inertia = Vector3d(b * b + c * c, a * a + c * c, a * a + b * b) / 3;
  Problem problem;
  Mat G(12, 6), weight = Mat::Identity(6, 6);
  weight.diagonal().tail(3) = inertia.cwiseInverse();
  const Vector3d foot_0(-a, -b, -c);
  for (int i = 0; i < 4; ++i) {
    const Vector3d foot(i % 2 ? a : -a, i / 2 ? b : -b, -c), slip = Vector3d(0, 0, -1).cross(foot - foot_0);
    const Vector3d directions[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    for (int k = 0; k < 3; ++k) G.row(3 * i + k) << directions[k].transpose(), foot.cross(directions[k]).transpose();
    ContactPoint& p = problem.points.emplace_back();
    p.normal = 3 * i, p.tangent = 3 * i + 1, p.tangents = 2, p.coefficient = mu;
    p.kind = i == 0 ? ContactPoint::Tangent::resting : ContactPoint::Tangent::sliding;
    if (i > 0) p.ratio = -mu * slip.head<2>().normalized();
  }
  Vec free(6);
  free << load + Vector3d(0, 0, -9.81), at.cross(load).cwiseQuotient(inertia);
  problem.A = G * weight * G.transpose();
  problem.b = G * free;
  return problem;
}

TEST(SlidingFeet, ShareAsEqualSpringsWhetherTheOtherHoldsOrSlips) {
  std::mt19937 random(61);
  std::uniform_real_distribution<double> any(-1, 1);
  int holds = 0, slips = 0;
  for (int i = 0; i < 600; ++i) {
    const Problem problem =
        turning_box(0.5 + 0.3 * any(random), 0.6 + 0.3 * any(random), 0.3 + 0.1 * any(random), 0.5,
                    {5 * any(random), 5 * any(random), any(random)}, {0.3 * any(random), 0.3 * any(random), 0});
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F)) << i;
    const Eigen::Vector4d N(answer.F[0], answer.F[3], answer.F[6], answer.F[9]);
    if (N.minCoeff() <= 0) continue;
    // Their self-stress is (1, -1, -1, 1): springs have none of it. Newton's method ends at 1e-12.
    EXPECT_NEAR(N[0] - N[1] - N[2] + N[3], 0, 1e-9 * N.norm()) << i << ": " << N.transpose();
    ++(answer.a.segment<2>(1).norm() > 1e-9 ? slips : holds);
  }
  EXPECT_GT(holds, 30);
  EXPECT_GT(slips, 30);
}

// The others then are those that springs leave.
TEST(SlidingFeet, ThatSpringsWouldLiftAreIdleAsThoseOfStiffSprings) {
  std::mt19937 random(268);
  std::uniform_real_distribution<double> any(-1, 1);
  int idle = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem rigid = turning_box(0.4 + 0.1 * any(random), 0.4 + 0.1 * any(random), 0.5, 0.5,
                                      {4 * any(random), 4 * any(random), any(random)},
                                      {0.3 * any(random), 0.3 * any(random), 0.4 * any(random)});
    Problem stiff = rigid;
    const double soft = 1e-7;
    stiff.A.diagonal().array() += soft * rigid.A.diagonal().maxCoeff();
    const Answer answer = solve(rigid), springs = solve(stiff);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    EXPECT_LE(offence(rigid, answer.F, answer.a), little(rigid, answer.F)) << i;
    if (springs.outcome != LcpOutcome::solved) continue;
    EXPECT_LE((answer.F - springs.F).norm(), 1e4 * soft * springs.F.norm()) << i << "\n"
                                                                            << answer.F.transpose() << "\n"
                                                                            << springs.F.transpose();
    for (const ContactPoint& p : rigid.points) idle += answer.F[p.normal] == 0 && answer.a[p.normal] == 0;
  }
  EXPECT_GT(idle, 50);
}

}  // namespace
}  // namespace trammel::complementarity
