#include "numerics/cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trammel::test {
namespace {

// Hilbert's matrix and the identity: positive definite, with a condition number of about 2.
Mat positive(Eigen::Index n) {
  return Mat::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) { return 1.0 / double(i + j + 1) + (i == j); });
}

class CholeskyOf : public testing::TestWithParam<int> {};

TEST_P(CholeskyOf, ReproducesTheMatrix) {
  const Mat M = positive(GetParam());
  numerics::Cholesky cholesky;
  ASSERT_TRUE(cholesky.compute(M));
  const Mat L = cholesky.factor().triangularView<Eigen::Lower>();
  EXPECT_LE((L * L.transpose() - M).lpNorm<Eigen::Infinity>(), 1e-14);
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

TEST_P(CholeskyOf, RefusesWhatIsNotPositiveDefinite) {
  Mat M = positive(GetParam());
  numerics::Cholesky cholesky;
  M(GetParam() - 1, GetParam() - 1) = -1e-3;
  EXPECT_FALSE(cholesky.compute(M));
  M(GetParam() - 1, GetParam() - 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.compute(M));
}

// By columns, and above 48 by blocks.
INSTANTIATE_TEST_SUITE_P(Sizes, CholeskyOf, testing::Values(1, 2, 7, 48, 49, 150));

}  // namespace
}  // namespace trammel::test
