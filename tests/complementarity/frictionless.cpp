// Without friction: a convex program, solved for any number of contacts, dependent or not, or proved to have no
// solution.
#include <cmath>
#include <limits>

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

// Of a heavy and a light body, in any units.
TEST(PressingForces, HoldBodiesOfAnyMass) {
  for (const double unit : {1.0, 1e-20, 1e20})
    for (const double heavy : {1.0, 1e-8, 1e-12}) {
      const Mat A = unit * Mat{{heavy, 0}, {0, 1}};
      Vec N;
      ASSERT_EQ(pressing_forces(A, Vec{{-2, -3}}, N), LcpOutcome::solved) << unit << " " << heavy;
      EXPECT_NEAR(N[0] * unit * heavy, 2, 1e-14);
      EXPECT_NEAR(N[1] * unit, 3, 1e-14);
    }
}

TEST(PressingForces, AreNoneWhereNothingApproachesOrIsANumber) {
  Vec N;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pressing_forces(Mat{{2}}, Vec{{0}}, N), LcpOutcome::solved);
  EXPECT_EQ(N[0], 0);
  EXPECT_EQ(pressing_forces(Mat{{nan}}, Vec{{-1}}, N), LcpOutcome::gave_up);
  EXPECT_EQ(pressing_forces(Mat{{2}}, Vec{{nan}}, N), LcpOutcome::gave_up);
}

// Walls that close in on a body by `closing`, one with `speed`: that each would press without the other is certain from
// 3e-7 of the speed times sqrt(2), the length of the forces (1, 1) in balance.
TEST(PressingForces, LetWallsCloseInByRoundOff) {
  const Mat A{{1, -1}, {-1, 1}};
  for (const double speed : {1e-3, 10.0, 1e5}) {
    const auto press = [&](double closing, Vec& N) {
      return pressing_forces(A, Vec{{-speed, speed - closing * std::sqrt(2.0) * speed}}, N);
    };
    Vec N;
    ASSERT_EQ(press(2.9e-7, N), LcpOutcome::solved) << speed;
    EXPECT_NEAR(N[0], speed, 1e-14 * speed);
    EXPECT_EQ(N[1], 0);
    ASSERT_EQ(press(3.1e-7, N), LcpOutcome::no_solution) << speed;
    EXPECT_LE((N - Vec{{1, 1}} / std::sqrt(2.0)).norm(), 1e-15);
  }
}

// A stack presses each of its contacts with what lies on it: the sums of the weights, to round-off.
TEST(PressingForces, OfAStackAreTheWeightsAbove) {
  for (const int n : {1, 2, 5, 40}) {
    Mat A = Mat::Zero(n, n);  // contact k is below block k
    for (int k = 0; k < n; ++k) {
      A(k, k) = k == 0 ? 1 : 2;
      if (k > 0) A(k, k - 1) = A(k - 1, k) = -1;
    }
    Vec b = Vec::Zero(n), N;
    b[0] = -10;  // the floor is at rest, and the blocks fall alike
    ASSERT_EQ(pressing_forces(A, b, N), LcpOutcome::solved);
    for (int k = 0; k < n; ++k) EXPECT_NEAR(N[k], 10 * (n - k), 1e-13 * n * n);
  }
}

}  // namespace
}  // namespace trammel::complementarity
