// Friction in space, up to four contacts: found, or proved not to exist; against a dense polyhedral cone and a
// compliant law.
#include <gtest/gtest.h>

#include <cmath>

#include "complementarity/programs/polyhedral_cone.hpp"
#include "random_problems.hpp"
#include "spatial_bodies.hpp"

namespace trammel::complementarity {
namespace {

RandomKinds any_kinds(std::mt19937& random, int contacts) {
  RandomKinds kinds;
  kinds.contacts = contacts;
  kinds.velocities = 1 + int(random() % unsigned(3 * contacts + 2));
  const double coefficients[] = {0.3, 1, 3, 100};
  kinds.most_friction = coefficients[random() % 4];
  kinds.unilateral_only = random() % 2 == 0;
  kinds.resting_only = random() % 2 == 0;
  return kinds;
}

double uniform_coefficient(std::mt19937& random) {
  return std::uniform_real_distribution<double>(0.2, 1)(random);
}

bool dense_polyhedral_cone_has_forces(const Problem& problem) {
  const PolyhedralCone cone(problem.points, problem.A, problem.b, 0, 64);
  Vec z, w;
  return solve_lcp(cone.M(), cone.q(), z, w) == LcpOutcome::solved;
}

void expect_forces_or_a_proof(const Problem& problem, int number) {
  const Answer answer = solve(problem);
  if (answer.outcome == LcpOutcome::solved) {
    EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F)) << problem.kind << ", " << number;
    return;
  }
  EXPECT_EQ(answer.outcome, LcpOutcome::no_solution) << "gave up on " << problem.kind << ", " << number;
  EXPECT_FALSE(dense_polyhedral_cone_has_forces(problem)) << problem.kind << ", " << number;
}

TEST(SpatialFriction, IsFoundOrProvedNotToExist) {
  std::mt19937 random(61);
  for (int i = 0; i < 20000; ++i) expect_forces_or_a_proof(random_spatial(random, any_kinds(random, 1 + i % 4)), i);
  for (int i = 0; i < 2000; ++i) expect_forces_or_a_proof(any_spatial_structure(random, 2), i);
}

// Where a ball is about to be wedged. Some of these problems have minima of the natural map that are no solutions, and
// Newton's method ends there.
TEST(SpatialFriction, IsFoundForAPlateThatLeansOnBalls) {
  std::mt19937 random(63);
  int gave_up = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = plate_on_balls(random, 3 + i % 4, uniform_coefficient(random));
    const Problem renamed = permuted(problem, random_order(random, problem.points.size()));
    for (const Problem& each : {problem, renamed}) {
      const Answer answer = solve(each);
      gave_up += answer.outcome != LcpOutcome::solved;
      if (answer.outcome != LcpOutcome::solved) continue;
      EXPECT_LE(offence(each, answer.F, answer.a), little(each, answer.F)) << i;
    }
  }
  EXPECT_EQ(gave_up, 0);
}

// Contacts that yield: a + e F in place of a, by sweeps over the contacts, each projected for itself.
Vec compliant_forces(const Problem& problem, double e) {
  Vec F = Vec::Zero(problem.b.size());
  for (int sweep = 0; sweep < 200000; ++sweep) {
    const Vec before = F;
    for (const ContactPoint& p : problem.points) {
      const double stiff = problem.A(p.normal, p.normal) + e;
      F[p.normal] =
          std::max(0.0, F[p.normal] - (problem.A.row(p.normal).dot(F) + problem.b[p.normal] + e * F[p.normal]) / stiff);
      const double both = problem.A.block(p.tangent, p.tangent, 2, 2).trace() + e;
      Eigen::Vector2d T = F.segment<2>(p.tangent);
      T -= (problem.A.middleRows(p.tangent, 2) * F + problem.b.segment(p.tangent, 2) + e * T) / both;
      if (const double bound = p.coefficient * F[p.normal]; T.norm() > bound) T *= bound / T.norm();
      F.segment<2>(p.tangent) = T;
    }
    if ((F - before).lpNorm<Eigen::Infinity>() <= 1e-12 * F.lpNorm<Eigen::Infinity>()) break;
  }
  return F;
}

// Coefficients up to 0.3, where accelerations are unique: what the stiff law tends to. It yields by e F.
TEST(SpatialFriction, HasTheAccelerationsOfACompliantLawThatGrowsStiff) {
  std::mt19937 random(62);
  for (int i = 0; i < 150; ++i) {
    const Problem problem = any_spatial_structure(random, 0.3);
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << problem.kind;
    double before = 0;
    for (const double softness : {1e-2, 1e-3}) {
      const double e = softness * problem.A.diagonal().maxCoeff();
      const Vec a = problem.A * compliant_forces(problem, e) + problem.b;
      const double off = (a - answer.a).lpNorm<Eigen::Infinity>();
      EXPECT_LE(off, 10 * softness * problem.b.lpNorm<Eigen::Infinity>()) << problem.kind << ", " << i;
      EXPECT_TRUE(before <= 1e-6 || off <= 0.2 * before) << problem.kind << ", " << i;  // of first order
      before = off;
    }
  }
}

TEST(SpatialFriction, DoesNotDependOnTheOrderOfContacts) {
  std::mt19937 random(63);
  for (int i = 0; i < 2000; ++i) {
    const Problem problem =
        i % 2 ? any_spatial_structure(random, 1) : random_spatial(random, any_kinds(random, 2 + i % 3));
    const std::vector<std::size_t> order = random_order(random, problem.points.size());
    const Answer first = solve(problem), other = solve(permuted(problem, order));
    ASSERT_EQ(first.outcome, other.outcome) << problem.kind << ", " << i;
    const Vec F = permuted_back(problem, order, other.F);
    EXPECT_LE((F - first.F).lpNorm<Eigen::Infinity>(), 1e-8 * F.lpNorm<Eigen::Infinity>()) << problem.kind << ", " << i;
  }
}

}  // namespace
}  // namespace trammel::complementarity
