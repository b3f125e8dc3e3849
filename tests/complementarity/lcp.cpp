#include "complementarity/programs/lcp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/LU>

namespace trammel::complementarity {
namespace {

Mat random_positive_definite(std::mt19937& random, int n) {
  std::normal_distribution<double> normal;
  const Mat A = Mat::NullaryExpr(n, n, [&] { return normal(random); });
  return A * A.transpose() + 0.1 * Mat::Identity(n, n);
}

Vec random_vector(std::mt19937& random, int n) {
  std::normal_distribution<double> normal;
  return Vec::NullaryExpr(n, [&] { return normal(random); });
}

// How far (z, w) is from a solution, whatever it claims.
double violation(const Mat& M, const Vec& q, const Vec& z, const Vec& w) {
  const double equation = (M * z + q - w).cwiseAbs().maxCoeff();
  const double signs = std::max(0.0, std::max(-z.minCoeff(), -w.minCoeff()));
  return std::max({equation, signs, z.cwiseProduct(w).cwiseAbs().maxCoeff()});
}

TEST(Lcp, SolvesTheTextbookInstance) {
  // Murty, Linear Complementarity (1988), section 2.2: M P-matrix, q = (-5, -6): z = (4/3, 7/3).
  const Mat M{{2, 1}, {1, 2}};
  const Vec q{{-5, -6}};
  Vec z, w;
  ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
  EXPECT_NEAR(z[0], 4.0 / 3, 1e-15);  // a few roundings of numbers near 1
  EXPECT_NEAR(z[1], 7.0 / 3, 1e-15);
}

TEST(Lcp, OfOneContactIsAQuotientOrHasNoSolution) {
  Vec z, w;
  ASSERT_EQ(solve_lcp(Mat{{2}}, Vec{{-3}}, z, w), LcpOutcome::solved);
  EXPECT_EQ(z[0], 1.5);
  EXPECT_EQ(w[0], 0);
  for (const double does_not_push : {0.0, -1.0}) {
    EXPECT_EQ(solve_lcp(Mat{{does_not_push}}, Vec{{-3}}, z, w), LcpOutcome::no_solution);
    EXPECT_EQ(z[0], 0);
    EXPECT_EQ(w[0], 0);
  }
}

TEST(Lcp, LeavesWhatIsNonnegativeAlone) {
  const Mat M{{1, 0}, {0, 1}};
  const Vec q{{0, 3}};
  Vec z, w;
  ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
  EXPECT_EQ(z, Vec::Zero(2));
  EXPECT_EQ(w, q);
}

TEST(Lcp, AnApproachOfOneRoundingNeedsNoForce) {
  Vec z, w;
  ASSERT_EQ(solve_lcp(Mat::Identity(3, 3), Vec{{2, -2e-16, 0.5}}, z, w), LcpOutcome::solved);
  EXPECT_EQ(z, Vec::Zero(3));
  EXPECT_EQ(w, (Vec{{2, 0, 0.5}}));
}

// n knots of a string that is pressed to one side only.
Mat string_of(int n) {
  return Mat::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) { return i == j ? 2.0 : -(std::abs(i - j) == 1); });
}

// Under -1 everywhere all of it gives way, like a parabola. Each force takes a pivot.
TEST(Lcp, FindsTheParabolaOfALoadedString) {
  for (const int n : {3, 39, 40, 41, 80, 130}) {
    Vec z, w;
    ASSERT_EQ(solve_lcp(string_of(n), Vec::Constant(n, -1), z, w), LcpOutcome::solved) << n;
    EXPECT_EQ(w, Vec::Zero(n)) << n;
    for (int i = 0; i < n; ++i) EXPECT_NEAR(z[i], (i + 1.) * (n - i) / 2, 1e-12 * n * n) << n;  // condition n^2 / 2
  }
}

// The forces found are computed once more by themselves, so that no pivot's round-off is left.
void expect_solved_to_round_off(const Mat& M, const Vec& q) {
  Vec z, w;
  ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
  EXPECT_LT((M * z + q - w).cwiseAbs().maxCoeff(), 2e-15 * (M.cwiseAbs() * z + q.cwiseAbs()).maxCoeff());
  EXPECT_GE(z.minCoeff(), 0);
  EXPECT_GE(w.minCoeff(), 0);
  EXPECT_EQ(z.cwiseProduct(w), Vec::Zero(q.size()));
}

TEST(Lcp, SolvesProblemsOfManyPivotsToRoundOff) {
  std::mt19937 random(4);
  for (int n = 60; n < 120; ++n) {
    SCOPED_TRACE(n);
    expect_solved_to_round_off(random_positive_definite(random, n) / n, random_vector(random, n) - Vec::Ones(n));
    expect_solved_to_round_off(string_of(n), random_vector(random, n) - Vec::Constant(n, 0.2));
  }
}

TEST(Lcp, SolvesRandomPMatricesOfEverySizeAndSign) {
  std::mt19937 random(1);
  for (int n = 1; n <= 12; ++n)
    for (int repeat = 0; repeat < 200; ++repeat) {
      Mat M = random_positive_definite(random, n);
      // A skew part keeps x^T M x, so M stays a P-matrix but is no longer symmetric.
      const Mat S = Mat::NullaryExpr(n, n, [&] { return std::normal_distribution<double>()(random); });
      M += S - S.transpose();
      const Vec q = random_vector(random, n);
      Vec z, w;
      ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved) << n;
      // Solved by elimination with pivots as they come: the loss stays below 1e5 roundings here.
      EXPECT_LT(violation(M, q, z, w), 1e-11 * (1 + z.cwiseAbs().maxCoeff()) * M.cwiseAbs().maxCoeff()) << n;
    }
}

TEST(Lcp, FindsTheOnlySolutionThatEnumerationFinds) {
  std::mt19937 random(2);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const int n = 4;
    const Mat M = random_positive_definite(random, n);
    const Vec q = random_vector(random, n);
    Vec z, w;
    ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
    for (int set = 0; set < 1 << n; ++set) {
      std::vector<int> active;
      for (int i = 0; i < n; ++i)
        if (set >> i & 1) active.push_back(i);
      Vec candidate = Vec::Zero(n);
      if (!active.empty()) candidate(active) = M(active, active).eval().inverse() * -q(active);
      if (candidate.minCoeff() < 0 || (M * candidate + q).minCoeff() < -1e-12) continue;
      EXPECT_LT((candidate - z).cwiseAbs().maxCoeff(), 1e-10);  // condition numbers to 1e4 times round-off
    }
  }
}

TEST(Lcp, ResolvesDegeneratePivotsOfRedundantContacts) {
  // Four contacts under one rigid body with three freedoms: the Delassus matrix has rank 2, and q lies in its range.
  const Mat J{{1, 1}, {1, -1}, {1, 1}, {1, -1}};
  const Mat M = J * J.transpose();
  const Vec q = Vec::Constant(4, -1);
  Vec z, w;
  ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
  EXPECT_LT(violation(M, q, z, w), 1e-14);
}

TEST(Lcp, SolvesManyDegenerateProblemsWithoutCycling) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> small(-1, 1);
  for (int repeat = 0; repeat < 500; ++repeat) {
    const int n = 6;
    const Mat J = Mat::NullaryExpr(n, 3, [&] { return double(small(random)); });
    const Mat M = J * J.transpose();  // positive semi-definite: a feasible problem has a solution
    const Vec q = J * Vec::NullaryExpr(3, [&] { return double(small(random)); });
    Vec z, w;
    ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved) << M << "\n" << q;  // feasible: z = -(J J^T)^+ q gives w = 0
    EXPECT_LT(violation(M, q, z, w), 1e-12);
  }
}

// All contacts are loaded alike, as by the accelerations of their normals' sum: whole groups of ratios are equal.
TEST(Lcp, SolvesProblemsOfEqualRatiosWithoutCycling) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> small(-1, 1);
  for (int repeat = 0; repeat < 5000; ++repeat) {
    const int n = 4 + repeat % 8;
    const Mat J = Mat::NullaryExpr(n, 2 + repeat % 4, [&] { return double(small(random)); });
    const Mat M = J * J.transpose();
    const Vec q = -M * Vec::Ones(n);
    Vec z, w;
    ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved) << M << "\n" << q;  // z = 1 is a solution
    ASSERT_LT(violation(M, q, z, w), 1e-12) << M << "\n" << q;
  }
}

TEST(Lcp, ScalesWithTheUnitsOfForcesAndRates) {
  std::mt19937 random(6);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Mat M = random_positive_definite(random, 8);
    const Vec q = random_vector(random, 8);
    Vec z, w, z_scaled, w_scaled;
    ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
    for (const double rate : {1e-12, 1e12})
      for (const double softness : {1e-6, 1e6}) {
        ASSERT_EQ(solve_lcp(softness * M, rate * q, z_scaled, w_scaled), LcpOutcome::solved);
        // Condition numbers to 1e4 times round-off.
        EXPECT_LT((softness / rate * z_scaled - z).cwiseAbs().maxCoeff(), 1e-11 * z.maxCoeff());
        EXPECT_LT((w_scaled / rate - w).cwiseAbs().maxCoeff(), 1e-11 * q.cwiseAbs().maxCoeff());
      }
  }
}

TEST(Lcp, SaysWhenThereIsNoSolution) {
  const Mat M{{0, 0}, {0, 0}};
  const Vec q{{-1, 1}};
  Vec z, w;
  EXPECT_EQ(solve_lcp(M, q, z, w), LcpOutcome::no_solution);
}

TEST(Lcp, GivesUpOnNumbersThatAreNotFinite) {
  Vec z, w;
  for (const int n : {1, 2})
    for (const double number : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      EXPECT_EQ(solve_lcp(Mat::Constant(n, n, number), Vec::Constant(n, -1), z, w), LcpOutcome::gave_up);
      EXPECT_EQ(z, Vec::Zero(n));
      EXPECT_EQ(solve_lcp(Mat::Identity(n, n), Vec::Constant(n, -number), z, w), LcpOutcome::gave_up);
      EXPECT_EQ(z, Vec::Zero(n));
    }
}

}  // namespace
}  // namespace trammel::complementarity
