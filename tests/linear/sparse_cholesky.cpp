#include "linear/sparse/sparse_cholesky.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

constexpr int n = 40;

// A chain closed to a ring: elimination fills it.
Mat ring() {
  Mat M = 4 * Mat::Identity(n, n);
  for (int i = 0; i < n; ++i) M(i, (i + 1) % n) = M((i + 1) % n, i) = -1 + 0.01 * i;
  return M;
}

TEST(SparseCholesky, Solves) {
  const Mat M = ring();
  numerics::SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.compute(M.sparseView()));
  const Vec known = Vec::LinSpaced(n, -1, 2);
  Vec x = M * known;
  cholesky.solve(x);
  EXPECT_LE((x - known).lpNorm<Eigen::Infinity>(), 1e-14);
}

// C^-1 M C^-T = 1
TEST(SparseCholesky, SplitsTheMatrixIntoEqualHalves) {
  numerics::SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.compute(ring().sparseView()));
  Mat half = ring();
  cholesky.solve_lower_of_rows(half);
  Mat whole = half.transpose();
  cholesky.solve_lower_of_rows(whole);
  EXPECT_LE((whole - Mat::Identity(n, n)).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(SparseCholesky, SolvesWithBothHalvesInTurn) {
  numerics::SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.compute(ring().sparseView()));
  Vec x = Vec::LinSpaced(n, 1, -3), y = x;
  cholesky.solve_lower(x);
  cholesky.solve_transposed(x);
  cholesky.solve(y);
  EXPECT_LE((x - y).lpNorm<Eigen::Infinity>(), 1e-15);
}

TEST(SparseCholesky, RefusesWhatIsNotPositiveDefinite) {
  Mat M = ring();
  M(7, 7) = -4;
  EXPECT_FALSE(numerics::SparseCholesky().compute(M.sparseView()));
  M(7, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(numerics::SparseCholesky().compute(M.sparseView()));
}

}  // namespace
}  // namespace trammel::test
