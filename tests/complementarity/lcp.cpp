#include "complementarity/programs/lcp.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(Lcp, LeavesWhatIsNonnegativeAlone) {
  const Mat M{{1, 0}, {0, 1}};
  const Vec q{{0, 3}};
  Vec z, w;
  ASSERT_EQ(solve_lcp(M, q, z, w), LcpOutcome::solved);
  EXPECT_EQ(z, Vec::Zero(2));
  EXPECT_EQ(w, q);
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

TEST(Lcp, SaysWhenThereIsNoSolution) {
  const Mat M{{0, 0}, {0, 0}};
  const Vec q{{-1, 1}};
  Vec z, w;
  EXPECT_EQ(solve_lcp(M, q, z, w), LcpOutcome::no_solution);
}

TEST(Lcp, GivesUpOnNumbersThatAreNotFinite) {
  const Mat M = Mat::Constant(2, 2, std::nan(""));
  Vec z, w;
  EXPECT_EQ(solve_lcp(M, Vec::Constant(2, -1), z, w), LcpOutcome::gave_up);
}

}  // namespace
}  // namespace trammel::complementarity
