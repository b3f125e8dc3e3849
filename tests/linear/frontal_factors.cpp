#include "linear/fronts/frontal_factors.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace trammel::test {
namespace {

using numerics::FrontalFactors;

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

// Positive definite: diagonally dominant.
Mat definite(const Mat& A) {
  Mat S = (A + A.transpose()) / 2;
  S.diagonal().array() = 0;
  S.diagonal() = 1.1 * S.cwiseAbs().rowwise().sum().array() + 0.1;
  return S;
}

// With the pattern made symmetric, and the diagonal.
FrontalFactors::Sparse sparse(const Mat& A) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < A.cols(); ++j)
    for (int i = 0; i < A.rows(); ++i)
      if (i == j || A(i, j) != 0 || A(j, i) != 0) entries.emplace_back(i, j, A(i, j));
  FrontalFactors::Sparse S(A.rows(), A.cols());
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

bool factorise(FrontalFactors& factors, const Mat& A) {
  const auto S = sparse(A);
  factors.analyse(S);
  return factors.factorise(S);
}

double error_of(FrontalFactors& factors, const Mat& A) {
  const Vec known = Vec::LinSpaced(A.rows(), -1, 2);
  Vec x;
  EXPECT_TRUE(factors.solve(sparse(A), A * known, x));
  return (x - known).norm() / known.norm();
}

class FrontalFactorsOf : public testing::TestWithParam<std::tuple<int, int, int, int>> {};

TEST_P(FrontalFactorsOf, SolvesAsWellAsADenseElimination) {
  const auto [side, reach, full, rows] = GetParam();
  for (int seed = 0; seed < 5; ++seed) {
    const Mat A = bordered(grid(side, reach, seed), full, rows, seed);
    const Vec known = Vec::LinSpaced(A.rows(), -1, 2);
    const double dense = (A.partialPivLu().solve(A * known) - known).norm() / known.norm();
    FrontalFactors factors;
    ASSERT_TRUE(factorise(factors, A));
    EXPECT_LE(error_of(factors, A), 100 * (dense + std::numeric_limits<double>::epsilon())) << "seed " << seed;
  }
}

TEST_P(FrontalFactorsOf, SolvesByCholeskyWhatIsPositiveDefinite) {
  const auto [side, reach, full, rows] = GetParam();
  for (int seed = 0; seed < 5; ++seed) {
    const Mat A = definite(bordered(grid(side, reach, seed), full, rows, seed));
    FrontalFactors factors;
    ASSERT_TRUE(factorise(factors, A));
    EXPECT_TRUE(factors.by_cholesky());
    EXPECT_LE(error_of(factors, A), 1e-14) << "seed " << seed;
  }
}

// A membrane of 24 x 24 points. Its rows sum to 0 inside: corrections make up for nothing that is wrong in the factors,
// as they do where the diagonal dominates.
TEST(FrontalFactors, SolvesByCholeskyTheEquationsOfAMembrane) {
  constexpr int side = 24;
  Mat A = 4 * Mat::Identity(side * side, side * side);
  for (int i = 0; i < side * side; ++i) {
    if (i + side < side * side) A(i, i + side) = A(i + side, i) = -1;
    if ((i + 1) % side != 0) A(i, i + 1) = A(i + 1, i) = -1;
  }
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, A));
  EXPECT_TRUE(factors.by_cholesky());
  EXPECT_LE(error_of(factors, A), 1e-13);  // its condition is 4 (25/pi)^2 = 250; 250 eps = 6e-14
}

// Side, reach, unknowns tied to all, rows without a diagonal.
INSTANTIATE_TEST_SUITE_P(Grids, FrontalFactorsOf,
                         testing::Values(std::tuple(8, 1, 0, 0), std::tuple(12, 2, 3, 0), std::tuple(12, 1, 0, 20),
                                         std::tuple(14, 3, 3, 5)));

TEST(FrontalFactors, TakesPartsThatNothingTies) {
  const Mat part = grid(6, 1, 1);
  Mat A = Mat::Zero(3 * part.rows(), 3 * part.rows());
  for (int k = 0; k < 3; ++k) A.block(k * part.rows(), k * part.rows(), part.rows(), part.rows()) = part;
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, A));
  EXPECT_LE(error_of(factors, A), 1e-14);
}

// Its largest entries are beside the diagonal, between unknowns of one node.
TEST(FrontalFactors, ExchangesRowsWithinAFront) {
  Mat A = grid(10, 1, 1);
  for (Eigen::Index i = 0; i < A.rows(); i += 3) A.middleCols<2>(i).rowwise().reverseInPlace();
  for (Eigen::Index i = 0; i < A.rows(); i += 3) A(i, i) = A(i + 1, i + 1) = 0;
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, A));
  EXPECT_LE(error_of(factors, A), 1e-13);
}

TEST(FrontalFactors, TakesOtherNumbersOfTheSamePattern) {
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, grid(10, 2, 1)));
  Mat B = grid(10, 2, 2);
  B(0, 1) = 0;
  ASSERT_TRUE(factors.factorise(sparse(B)));
  EXPECT_LE(error_of(factors, B), 1e-14);
}

TEST(FrontalFactors, TakesAnotherSizeAfresh) {
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, grid(12, 1, 1)));
  ASSERT_TRUE(factorise(factors, grid(9, 1, 1)));
  EXPECT_LE(error_of(factors, grid(9, 1, 1)), 1e-14);
}

TEST(FrontalFactors, TakesFullMatricesAsOneFront) {
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, grid(5, 4, 1)));
  EXPECT_LE(error_of(factors, grid(5, 4, 1)), 1e-13);
}

TEST(FrontalFactors, TakesSmallMatrices) {
  for (int n : {1, 2, 7}) {
    FrontalFactors factors;
    ASSERT_TRUE(factorise(factors, 4 * Mat::Identity(n, n)));
    EXPECT_EQ(error_of(factors, 4 * Mat::Identity(n, n)), 0) << n;
  }
}

TEST(FrontalFactors, SolvesEquationsWhoseRightSideIsZero) {
  for (const Mat& A : {grid(5, 1, 1), definite(grid(5, 1, 1))}) {
    FrontalFactors factors;
    ASSERT_TRUE(factorise(factors, A));
    Vec x;
    EXPECT_TRUE(factors.solve(sparse(A), Vec::Zero(A.rows()), x));
    ASSERT_EQ(x.size(), A.rows());
    EXPECT_TRUE(x.isZero(0));
  }
}

// As the sums of blocks leave it: solutions are those of A itself.
TEST(FrontalFactors, TakesForSymmetricWhatIsButForRounding) {
  Mat A = definite(grid(10, 2, 1));
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * A.cwiseAbs().maxCoeff();
  A.triangularView<Eigen::StrictlyLower>() = A + rounding * (A.array() != 0).cast<double>().matrix();
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, A));
  EXPECT_TRUE(factors.by_cholesky());
  EXPECT_LE(error_of(factors, A), 1e-14);
}

TEST(FrontalFactors, TakesNeitherUnsymmetricNorIndefiniteForDefinite) {
  const Mat A = definite(grid(10, 2, 1));
  Mat unsymmetric = A, negative = A, indefinite = A;
  unsymmetric(7, 3) *= 1 + 1e-9;
  negative(40, 40) *= -1;
  indefinite.topLeftCorner<3, 3>() = Eigen::Matrix3d{{1, 5, 0}, {5, 1, 0}, {0, 0, 1}};
  for (const Mat& other : {unsymmetric, negative, indefinite}) {
    FrontalFactors factors;
    ASSERT_TRUE(factorise(factors, other));
    EXPECT_FALSE(factors.by_cholesky());
    EXPECT_LE(error_of(factors, other), 1e-13);
  }
}

TEST(FrontalFactors, ChoosesAnewForOtherNumbers) {
  const Mat A = definite(grid(10, 2, 1)), B = grid(10, 2, 2);
  FrontalFactors factors;
  ASSERT_TRUE(factorise(factors, A));
  for (const Mat* next : {&B, &A}) {
    ASSERT_TRUE(factors.factorise(sparse(*next)));
    EXPECT_EQ(factors.by_cholesky(), next == &A);
    EXPECT_LE(error_of(factors, *next), 1e-14);
  }
}

// A run that is resumed is another process, in other memory.
TEST(FrontalFactors, RoundsAlikeWhereverItsMemoryLies) {
  for (const Mat& A : {grid(8, 1, 1), definite(grid(8, 1, 1))}) {
    const Vec b = Vec::LinSpaced(A.rows(), -1, 2);
    std::vector<std::unique_ptr<char[]>> between;
    Vec first, x;
    for (std::size_t bytes = 16; bytes <= 128; bytes += 16) {
      between.push_back(std::make_unique<char[]>(bytes));
      FrontalFactors factors;
      ASSERT_TRUE(factorise(factors, A));
      ASSERT_TRUE(factors.solve(sparse(A), b, first.size() == 0 ? first : x));
      EXPECT_TRUE(x.size() == 0 || x == first);
    }
  }
}

TEST(FrontalFactors, RefusesASingularMatrix) {
  Mat A = grid(10, 1, 1);
  A.row(100) = 2 * A.row(101);
  FrontalFactors factors;
  EXPECT_FALSE(factorise(factors, A));
  A.row(100).setZero();
  EXPECT_FALSE(factorise(factors, A));
}

TEST(FrontalFactors, RefusesRowsThatSayTheSame) {
  Mat A = bordered(grid(10, 1, 1), 0, 2, 1);
  const Eigen::Index last = A.rows() - 1;
  A.row(last) = A.row(last - 1), A.col(last) = A.col(last - 1);
  FrontalFactors factors;
  EXPECT_FALSE(factorise(factors, A));
}

TEST(FrontalFactors, RefusesNumbersThatAreNone) {
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mat A = grid(10, 1, 1);
    A(150, 150) = none;
    FrontalFactors factors;
    EXPECT_FALSE(factorise(factors, A));
  }
}

}  // namespace
}  // namespace trammel::test
