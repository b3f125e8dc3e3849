#include "linear/dense/partial_cholesky.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

using Index = Eigen::Index;

// Lower triangle of n columns; what stands above is of no account.
struct Lower {
  explicit Lower(const Mat& A) : n(A.rows()), numbers(Vec::Constant(n * numerics::column_stride(n), -7)) {
    view().triangularView<Eigen::Lower>() = A;
  }
  Eigen::Map<Mat, 0, Eigen::OuterStride<>> view() {
    return {numbers.data(), n, n, Eigen::OuterStride<>(numerics::column_stride(n))};
  }
  Index n;
  Vec numbers;
};

Mat definite(Index n) {
  std::mt19937 random{unsigned(n)};
  std::uniform_real_distribution<double> number(-1, 1);
  const Mat X = Mat::NullaryExpr(n, n, [&] { return number(random); });
  return X * X.transpose() + Mat::Identity(n, n);
}

TEST(PartialCholesky, LeavesTheFactorsColumnsAndTheComplement) {
  for (const Index n : {1, 2, 3, 4, 5, 7, 8, 9, 12, 13, 16, 17, 31, 48, 100, 161})
    for (const Index k : {Index(1), Index(2), Index(5), Index(8), Index(9), Index(23), Index(70), n - 1, n}) {
      if (k < 1 || k > n) continue;
      const Mat A = definite(n);
      Lower F(A);
      ASSERT_TRUE(numerics::partial_cholesky(F.numbers.data(), n, k));
      Mat product = Mat::Zero(n, n);
      product.bottomRightCorner(n - k, n - k) = F.view().bottomRightCorner(n - k, n - k);
      Mat L = F.view().leftCols(k);
      L.topRows(k).triangularView<Eigen::StrictlyUpper>().setZero();
      product += L * L.transpose();
      const Mat error = (product - A).triangularView<Eigen::Lower>();
      EXPECT_LE(error.cwiseAbs().maxCoeff(),
                double(n) * std::numeric_limits<double>::epsilon() * A.diagonal().maxCoeff())
          << n << " " << k;
    }
}

TEST(PartialCholesky, RefusesWhatIsNotPositiveDefinite) {
  for (const Index bad : {0, 7, 8, 29}) {
    Mat A = definite(30);
    A(bad, bad) = -1;
    EXPECT_FALSE(numerics::partial_cholesky(Lower(A).numbers.data(), 30, 30)) << bad;
    A(bad, bad) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(numerics::partial_cholesky(Lower(A).numbers.data(), 30, 30)) << bad;
  }
}

TEST(PartialCholesky, RefusesWhatIsExactlySingular) {
  for (const Index n : {2, 8, 9, 30}) {
    EXPECT_FALSE(numerics::partial_cholesky(Lower(Mat::Ones(n, n)).numbers.data(), n, 2)) << n;
    EXPECT_TRUE(numerics::partial_cholesky(Lower(Mat::Ones(n, n)).numbers.data(), n, 1)) << n;
  }
}

// The complement may be anything.
TEST(PartialCholesky, AsksNothingOfTheRest) {
  Mat A = definite(30);
  A.bottomRightCorner(10, 10) *= -1;
  EXPECT_TRUE(numerics::partial_cholesky(Lower(A).numbers.data(), 30, 20));
}

}  // namespace
}  // namespace trammel::test
