#include "linear/dense/cholesky.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace trammel::test {
namespace {

// Hilbert's matrix and the identity: positive definite, with a condition number of about 2.
Mat positive(Eigen::Index n) {
  return Mat::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) { return 1.0 / double(i + j + 1) + (i == j); });
}

class CholeskyOf : public testing::TestWithParam<int> {};

// C^-1 M C^-T = 1
TEST_P(CholeskyOf, SplitsTheMatrixIntoEqualHalves) {
  const Mat M = positive(GetParam());
  numerics::Cholesky cholesky;
  ASSERT_TRUE(cholesky.compute(M));
  Mat half = M;
  cholesky.solve_lower_of_rows(half);
  Mat whole = half.transpose();
  cholesky.solve_lower_of_rows(whole);
  EXPECT_LE((whole - Mat::Identity(GetParam(), GetParam())).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST_P(CholeskyOf, TellsThePivotsOfTheHalves) {
  const Mat M = positive(GetParam());
  numerics::Cholesky cholesky;
  ASSERT_TRUE(cholesky.compute(M));
  double product = 1;
  for (int j = 0; j < GetParam(); ++j) product *= cholesky.pivot(j);
  const double expected = std::sqrt(M.determinant());
  EXPECT_NEAR(product, expected, 1e-13 * expected);
}

TEST_P(CholeskyOf, Solves) {
  const Mat M = positive(GetParam());
  const Vec known = Vec::LinSpaced(GetParam(), -1, 2);
  numerics::Cholesky cholesky;
  ASSERT_TRUE(cholesky.compute(M));
  Vec x = M * known;
  cholesky.solve(x);
  EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST_P(CholeskyOf, SolvesADiagonalMatrixAndAFullOneAfterIt) {
  const Vec known = Vec::LinSpaced(GetParam(), -1, 2), d = Vec::LinSpaced(GetParam(), 1, 1e9);
  numerics::Cholesky cholesky;
  ASSERT_TRUE(cholesky.compute(d.asDiagonal()));
  Vec x = d.asDiagonal() * known;
  cholesky.solve(x);
  EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_NEAR(cholesky.pivot(0), std::sqrt(d(0)), 1e-15 * std::sqrt(d(0)));
  const Mat M = positive(GetParam());
  ASSERT_TRUE(cholesky.compute(M));
  x = M * known;
  cholesky.solve(x);
  EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-13);
  EXPECT_FALSE(cholesky.compute((-d).asDiagonal()));
}

// Blocks on the diagonal, which begin elsewhere from one matrix to the next.
TEST_P(CholeskyOf, SolvesBlocksAndAFullMatrixAfterThem) {
  const Eigen::Index n = GetParam();
  const Vec known = Vec::LinSpaced(n, -1, 2);
  numerics::Cholesky cholesky;
  for (const Eigen::Index block : {n / 3, 2 * n / 3, n, n / 4}) {
    Mat M = positive(n);
    M.topRightCorner(block, n - block).setZero(), M.bottomLeftCorner(n - block, block).setZero();
    ASSERT_TRUE(cholesky.compute(M));
    Vec x = M * known;
    cholesky.solve(x);
    EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-13) << block;
    Mat half = M;
    cholesky.solve_lower_of_rows(half);
    EXPECT_LE((half * half.transpose() - M).lpNorm<Eigen::Infinity>(), 1e-13) << block;
    x = M.col(0);
    cholesky.solve_lower(x), cholesky.solve_transposed(x);
    EXPECT_LE((x - Vec::Unit(n, 0)).lpNorm<Eigen::Infinity>(), 1e-13) << block;
  }
}

TEST_P(CholeskyOf, RefusesWhatIsNotPositiveDefinite) {
  Mat M = positive(GetParam());
  numerics::Cholesky cholesky;
  M(GetParam() - 1, GetParam() - 1) = -1e-3;
  EXPECT_FALSE(cholesky.compute(M));
  M(GetParam() - 1, GetParam() - 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.compute(M));
}

// The last pivot is exactly 0.
TEST_P(CholeskyOf, RefusesWhatIsExactlySingular) {
  numerics::Cholesky cholesky;
  const Eigen::Index n = GetParam(), alike = std::min<Eigen::Index>(2, n);
  Mat M = Mat::Identity(n, n);
  M.bottomRightCorner(alike, alike).setOnes();
  EXPECT_EQ(cholesky.compute(M), n == 1);
  EXPECT_FALSE(cholesky.compute(Mat::Zero(n, n)));
}

TEST(Cholesky, OfABodyWithoutCoordinatesHasNothingToSolve) {
  numerics::Cholesky cholesky;
  for (const int before : {0, 60}) {  // in blocks
    ASSERT_TRUE(cholesky.compute(Mat::Identity(before, before) + Mat::Constant(before, before, 0.1)));
    ASSERT_TRUE(cholesky.compute(Mat(0, 0)));
    Vec x(0);
    Mat X(3, 0);
    cholesky.solve(x), cholesky.solve_lower(x), cholesky.solve_transposed(x), cholesky.solve_lower_of_rows(X);
  }
}

// By columns, and above 48 by blocks.
INSTANTIATE_TEST_SUITE_P(Sizes, CholeskyOf, testing::Values(1, 2, 7, 8, 11, 48, 49, 150));

}  // namespace
}  // namespace trammel::test
