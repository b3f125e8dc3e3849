// Without friction: a convex program, solved for any number of contacts, dependent or not, or proved to have no
// solution.
#include <gtest/gtest.h>

#include "complementarity/programs/nonnegative_least_squares.hpp"
#include "complementarity/shares/pressing_forces.hpp"
#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

Problem any_normals(std::mt19937& random, int i) {
  const int n = 1 + int(random() % (i % 10 == 0 ? 200 : 30)), velocities = 1 + int(random() % unsigned(2 * n));
  return random_normals(random, n, velocities, i % 3 == 0 ? 0.3 : 0);
}

// Contacts in the plane, without their tangents.
Problem normals_of(Problem problem) {
  std::vector<Eigen::Index> normals;
  for (std::size_t k = 0; k < problem.points.size(); ++k) normals.push_back(Eigen::Index(2 * k));
  problem.A = problem.A(normals, normals).eval(), problem.b = problem.b(normals).eval();
  for (std::size_t k = 0; k < problem.points.size(); ++k) problem.points[k] = {.normal = int(k)};
  return problem;
}

// d >= 0 in balance, A d = 0, pushes contacts that still approach.
void expect_proof(const Problem& problem, int number) {
  Vec d;
  ASSERT_EQ(pressing_forces(problem.A, problem.b, d), LcpOutcome::no_solution) << number;
  EXPECT_GE(d.minCoeff(), 0);
  EXPECT_NEAR(d.norm(), 1, 1e-14);
  EXPECT_LT(problem.b.dot(d), -1e-9 * problem.b.lpNorm<Eigen::Infinity>()) << number;
  // Solved for with a matrix whose pivots are more than 1e-13: some of the digits are lost.
  EXPECT_LT((problem.A * d).norm(), 1e-9 * problem.A.norm()) << number;
}

TEST(Frictionless, HasASolutionOrAProofThatThereIsNone) {
  std::mt19937 random(33);
  int without = 0;
  for (int i = 0; i < 1000; ++i) {
    const Problem problem = any_normals(random, i);
    const Answer answer = solve(problem);
    if (answer.outcome == LcpOutcome::no_solution) {
      expect_proof(problem, i);
      ++without;
      continue;
    }
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F)) << i;
  }
  EXPECT_GT(without, 50);
}

// Squeezed blocks, whose forces are in balance to the last digit but one.
TEST(Frictionless, StructuresHaveASolutionOrAProofThatThereIsNone) {
  std::mt19937 random(38);
  for (int i = 0; i < 3000; ++i) {
    const Problem problem = normals_of(any_structure(random, 8));
    const Answer answer = solve(problem);
    if (answer.outcome == LcpOutcome::no_solution) {
      expect_proof(problem, i);
      continue;
    }
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << problem.kind << ", " << i;
    EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F)) << problem.kind << ", " << i;
  }
}

// Consistent ones, b = G a_0, always have one: their accelerations are those nearest to a_0 that do not approach.
TEST(Frictionless, IsSolvedWhateverTheRankWhereGapsAreConsistent) {
  std::mt19937 random(34);
  for (int i = 0; i < 300; ++i) {
    const Problem problem = random_normals(random, 1 + int(random() % 60), 1 + int(random() % 20), 0);
    ASSERT_EQ(solve(problem).outcome, LcpOutcome::solved) << i << problem.kind;
  }
}

// Another algorithm: the least distance problem |G^T N + a_0| as a non-negative least squares problem.
TEST(Frictionless, HasTheAccelerationsOfAnotherAlgorithm) {
  std::mt19937 random(35);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i) {
    const int n = 1 + int(random() % 60), velocities = 1 + int(random() % 40);
    const Mat G = Mat::NullaryExpr(n, velocities, [&] { return normal(random); });
    const Vec a_0 = Vec::NullaryExpr(velocities, [&] { return normal(random); }) - 0.3 * G.transpose() * Vec::Ones(n);
    Problem problem{.points = {}, .A = G * G.transpose(), .b = G * a_0, .kind = {}};
    for (int k = 0; k < n; ++k) problem.points.push_back({.normal = k});
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    Vec N;
    nonnegative_least_squares(G.transpose(), -a_0, N);
    EXPECT_LE((answer.a - (problem.A * N + problem.b)).lpNorm<Eigen::Infinity>(), little(problem, answer.F)) << i;
  }
}

// Two blocks below a ceiling, the upper one beyond the right foot of the lower one except for `overlap` [m]: a strut
// from the ceiling through the upper block's corner to that foot, which the load beyond it presses.
Problem strut(double overlap) {
  PlanarBodies bodies;
  const double x = 0.36 - overlap;
  const int lower = bodies.add({0, 0.08}, 1, 0.0062, {0, 0, 0}), upper = bodies.add({x, 0.21}, 1, 0.0217, {2, -4, 0});
  for (const double side : {-1.0, 1.0}) {
    bodies.touch(PlanarBodies::ground, lower, {0.11 * side, 0}, {0, 1}, 0);
    bodies.touch(lower, upper, {x + 0.25 * side, 0.16}, {0, 1}, 0);
    bodies.touch(PlanarBodies::ground, upper, {x + 0.25 * side, 0.26}, {0, -1}, 0);
  }
  return normals_of(bodies.problem("strut"));
}

// The upper block's right corner presses the lower one with half of the load, 2 N. About the left one, 0.5 m away, the
// foot holds this with the overlap as its lever.
TEST(Frictionless, HoldsAStrutUntilItIsUpright) {
  for (const double overlap : {1e-1, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 1e-6}) {
    SCOPED_TRACE(overlap);
    const Problem problem = strut(overlap);
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved);
    EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F));
    EXPECT_NEAR(answer.F.maxCoeff() * overlap, 1, 1e-3);
    EXPECT_LE(answer.a.maxCoeff(), 1e-6);
  }
  for (const double overlap : {0.0, -1e-6, -1e-4, -1e-2}) {
    SCOPED_TRACE(overlap);
    const Answer answer = solve(strut(overlap));
    ASSERT_EQ(answer.outcome, LcpOutcome::solved);
    EXPECT_GT(answer.a.maxCoeff(), 0.1);
  }
}

TEST(Frictionless, KeepsItsForcesInAnyOrder) {
  std::mt19937 random(37);
  for (int i = 0; i < 300; ++i) {
    const Problem problem = random_normals(random, 2 + int(random() % 30), 1 + int(random() % 20), 0);
    const std::vector<std::size_t> order = random_order(random, problem.points.size());
    const Answer first = solve(problem), other = solve(permuted(problem, order));
    ASSERT_EQ(first.outcome, LcpOutcome::solved);
    ASSERT_EQ(other.outcome, LcpOutcome::solved);
    const Vec F = permuted_back(problem, order, other.F);
    EXPECT_LE((F - first.F).lpNorm<Eigen::Infinity>(), 1e-9 * F.lpNorm<Eigen::Infinity>()) << i << problem.kind;
  }
}

}  // namespace
}  // namespace trammel::complementarity
