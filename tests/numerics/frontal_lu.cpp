#include "numerics/frontal_lu.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace trammel::test {
namespace {

// Nodes of three unknowns in a grid, each tied to those up to `reach` away; unsymmetric numbers.
Mat grid(int side, int reach, int seed) {
  std::mt19937 random{unsigned(seed)};
  std::uniform_real_distribution<double> number(-1, 1);
  Mat A = Mat::Zero(3 * side * side, 3 * side * side);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = std::max(0, i - reach); k <= std::min(side - 1, i + reach); ++k)
        for (int l = std::max(0, j - reach); l <= std::min(side - 1, j + reach); ++l)
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) A(3 * (i * side + j) + a, 3 * (k * side + l) + b) = number(random);
  A.diagonal().array() += 8;
  return A;
}

// Rows and columns at the end: `full` of bodies tied to all, then `rows` without a diagonal, each on some unknowns.
Mat bordered(const Mat& inner, int full, int rows, int seed) {
  std::mt19937 random{unsigned(seed)};
  std::uniform_real_distribution<double> number(-1, 1);
  const Eigen::Index n = inner.rows(), all = n + full + rows;
  Mat A = Mat::Zero(all, all);
  A.topLeftCorner(n, n) = inner;
  for (int i = 0; i < full; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) A(n + i, j) = 0.1 * number(random), A(j, n + i) = 0.1 * number(random);
    A(n + i, n + i) = 20;
  }
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < 6; ++k) {
      const Eigen::Index j = (7 * i + k) % n, row = n + full + i;
      A(row, j) = A(j, row) = number(random) + (k == 0 ? 3 : 0);
    }
  return A;
}

// With the pattern made symmetric, and the diagonal.
numerics::FrontalLu::Sparse sparse(const Mat& A) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < A.cols(); ++j)
    for (int i = 0; i < A.rows(); ++i)
      if (i == j || A(i, j) != 0 || A(j, i) != 0) entries.emplace_back(i, j, A(i, j));
  numerics::FrontalLu::Sparse S(A.rows(), A.cols());
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

bool factorise(numerics::FrontalLu& lu, const Mat& A) {
  const auto S = sparse(A);
  lu.analyse(S);
  return lu.factorise(S);
}

double error_of(numerics::FrontalLu& lu, const Mat& A) {
  const Vec known = Vec::LinSpaced(A.rows(), -1, 2);
  Vec x;
  EXPECT_TRUE(lu.solve(sparse(A), A * known, x));
  return (x - known).norm() / known.norm();
}

class FrontalLuOf : public testing::TestWithParam<std::tuple<int, int, int, int>> {};

TEST_P(FrontalLuOf, SolvesAsWellAsADenseElimination) {
  const auto [side, reach, full, rows] = GetParam();
  for (int seed = 0; seed < 5; ++seed) {
    const Mat A = bordered(grid(side, reach, seed), full, rows, seed);
    const Vec known = Vec::LinSpaced(A.rows(), -1, 2);
    const double dense = (A.partialPivLu().solve(A * known) - known).norm() / known.norm();
    numerics::FrontalLu lu;
    ASSERT_TRUE(factorise(lu, A));
    EXPECT_LE(error_of(lu, A), 100 * (dense + std::numeric_limits<double>::epsilon())) << "seed " << seed;
  }
}

// Side, reach, unknowns tied to all, rows without a diagonal.
INSTANTIATE_TEST_SUITE_P(Grids, FrontalLuOf,
                         testing::Values(std::tuple(8, 1, 0, 0), std::tuple(12, 2, 3, 0), std::tuple(12, 1, 0, 20),
                                         std::tuple(14, 3, 3, 5)));

TEST(FrontalLu, TakesPartsThatNothingTies) {
  const Mat part = grid(6, 1, 1);
  Mat A = Mat::Zero(3 * part.rows(), 3 * part.rows());
  for (int k = 0; k < 3; ++k) A.block(k * part.rows(), k * part.rows(), part.rows(), part.rows()) = part;
  numerics::FrontalLu lu;
  ASSERT_TRUE(factorise(lu, A));
  EXPECT_LE(error_of(lu, A), 1e-14);
}

// Its largest entries are beside the diagonal, between unknowns of one node.
TEST(FrontalLu, ExchangesRowsWithinAFront) {
  Mat A = grid(10, 1, 1);
  for (Eigen::Index i = 0; i < A.rows(); i += 3) A.middleCols<2>(i).rowwise().reverseInPlace();
  for (Eigen::Index i = 0; i < A.rows(); i += 3) A(i, i) = A(i + 1, i + 1) = 0;
  numerics::FrontalLu lu;
  ASSERT_TRUE(factorise(lu, A));
  EXPECT_LE(error_of(lu, A), 1e-13);
}

TEST(FrontalLu, TakesOtherNumbersOfTheSamePattern) {
  numerics::FrontalLu lu;
  ASSERT_TRUE(factorise(lu, grid(10, 2, 1)));
  Mat B = grid(10, 2, 2);
  B(0, 1) = 0;
  ASSERT_TRUE(lu.factorise(sparse(B)));
  EXPECT_LE(error_of(lu, B), 1e-14);
}

TEST(FrontalLu, TakesAnotherSizeAfresh) {
  numerics::FrontalLu lu;
  ASSERT_TRUE(factorise(lu, grid(12, 1, 1)));
  ASSERT_TRUE(factorise(lu, grid(9, 1, 1)));
  EXPECT_LE(error_of(lu, grid(9, 1, 1)), 1e-14);
}

TEST(FrontalLu, TakesFullMatricesAsOneFront) {
  numerics::FrontalLu lu;
  ASSERT_TRUE(factorise(lu, grid(5, 4, 1)));
  EXPECT_LE(error_of(lu, grid(5, 4, 1)), 1e-13);
}

TEST(FrontalLu, TakesSmallMatrices) {
  for (int n : {1, 2, 7}) {
    numerics::FrontalLu lu;
    ASSERT_TRUE(factorise(lu, 3 * Mat::Identity(n, n)));
    EXPECT_EQ(error_of(lu, 3 * Mat::Identity(n, n)), 0) << n;
  }
}

// A run that is resumed is another process, in other memory.
TEST(FrontalLu, RoundsAlikeWhereverItsMemoryLies) {
  const Mat A = grid(8, 1, 1);
  const Vec b = Vec::LinSpaced(A.rows(), -1, 2);
  std::vector<std::unique_ptr<char[]>> between;
  Vec first, x;
  for (std::size_t bytes = 16; bytes <= 128; bytes += 16) {
    between.push_back(std::make_unique<char[]>(bytes));
    numerics::FrontalLu lu;
    ASSERT_TRUE(factorise(lu, A));
    ASSERT_TRUE(lu.solve(sparse(A), b, first.size() == 0 ? first : x));
    EXPECT_TRUE(x.size() == 0 || x == first);
  }
}

TEST(FrontalLu, RefusesASingularMatrix) {
  Mat A = grid(10, 1, 1);
  A.row(100) = 2 * A.row(101);
  numerics::FrontalLu lu;
  EXPECT_FALSE(factorise(lu, A));
  A.row(100).setZero();
  EXPECT_FALSE(factorise(lu, A));
}

TEST(FrontalLu, RefusesRowsThatSayTheSame) {
  Mat A = bordered(grid(10, 1, 1), 0, 2, 1);
  const Eigen::Index last = A.rows() - 1;
  A.row(last) = A.row(last - 1), A.col(last) = A.col(last - 1);
  numerics::FrontalLu lu;
  EXPECT_FALSE(factorise(lu, A));
}

TEST(FrontalLu, RefusesNumbersThatAreNone) {
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mat A = grid(10, 1, 1);
    A(150, 150) = none;
    numerics::FrontalLu lu;
    EXPECT_FALSE(factorise(lu, A));
  }
}

}  // namespace
}  // namespace trammel::test
