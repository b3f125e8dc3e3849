#include "linear/dense/lu.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trammel::test {
namespace {

// Well conditioned, with its largest entries off the diagonal: rows must be exchanged.
Mat shifted(int n) {
  Mat A = Mat::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) { return 1.0 / double(i + 2 * j + 3); });
  for (Eigen::Index i = 0; i < n; ++i) A((i + 1) % n, i) += 4;
  return A;
}

class LuOf : public testing::TestWithParam<int> {};

TEST_P(LuOf, SolvesWithRowsExchanged) {
  const Mat A = shifted(GetParam());
  const Vec known = Vec::LinSpaced(GetParam(), -1, 2);
  numerics::Lu lu;
  lu.compute(A);
  Vec x;
  lu.solve(A * known, x);
  EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-14 * GetParam());
}

// Without exchanges the pivots would be 1e-12, and four digits were left.
TEST_P(LuOf, LosesNoDigitsToSmallPivots) {
  const int n = GetParam();
  Mat A = 1e-12 * shifted(n);
  for (Eigen::Index i = 0; i < n; ++i) A((i + 1) % n, i) = 1 + 1 / double(i + 1);
  const Vec known = Vec::LinSpaced(n, -1, 2);
  numerics::Lu lu;
  lu.compute(A);
  Vec x;
  lu.solve(A * known, x);
  EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-15 * n);
  for (int j = 0; j < n; ++j) EXPECT_GE(std::abs(lu.pivot(j)), 0.9) << j;
}

TEST_P(LuOf, ShowsASingularMatrixByAPivotAtRoundOff) {
  Mat A = shifted(GetParam());
  A.row(0) = GetParam() > 1 ? 2 * A.row(GetParam() - 1) : 0 * A.row(0);
  numerics::Lu lu;
  lu.compute(A);
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < GetParam(); ++j) least = std::min(least, std::abs(lu.pivot(j)));
  EXPECT_LE(least, 1e-14);
}

TEST_P(LuOf, LeavesNoPivotFiniteBehindANumberThatIsNone) {
  Mat A = shifted(GetParam());
  A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  numerics::Lu lu;
  lu.compute(A);
  bool found = false;
  for (int j = 0; j < GetParam(); ++j) found = found || !std::isfinite(lu.pivot(j));
  EXPECT_TRUE(found);
}

// By columns, and above 48 by blocks.
INSTANTIATE_TEST_SUITE_P(Sizes, LuOf, testing::Values(1, 2, 7, 48, 49, 150));

}  // namespace
}  // namespace trammel::test
