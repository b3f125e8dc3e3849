// Factors of a semidefinite matrix, and the long chains of redundant rows that are solved with them.
#include <cmath>

#include <gtest/gtest.h>

#include "numerics/semidefinite_ldlt.hpp"
#include "numerics/sparse_kkt.hpp"

namespace trammel::numerics {
namespace {

SemidefiniteLdlt::Sparse sparse(const Mat& A) {
  return A.sparseView();
}

TEST(SemidefiniteLdlt, SolvesADefiniteSystem) {
  const Mat B = Mat::NullaryExpr(
      8, 8, [](Eigen::Index i, Eigen::Index j) { return std::abs(i - j) < 3 ? std::sin(1.0 + double(i * i + j)) : 0; });
  const Mat A = B.transpose() * B + 0.1 * Mat::Identity(8, 8);
  SemidefiniteLdlt factors;
  factors.analyse(sparse(A));
  factors.factorise(sparse(A), 1e-12);
  EXPECT_TRUE(factors.dependent().empty());
  Vec x = A * Vec::LinSpaced(8, 1, -2);
  factors.solve(x);
  EXPECT_LT((x - Vec::LinSpaced(8, 1, -2)).norm(), 1e-12);
}

// Nine columns of which three are sums of the others.
TEST(SemidefiniteLdlt, FindsDependentRowsAndLeavesTheOthersAlone) {
  Mat B = Mat::NullaryExpr(
      12, 9, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + double(3 * i * i + 7 * j + i * j)); });
  B.col(2) = B.col(0) + B.col(1), B.col(5) = B.col(3) - B.col(4), B.col(8) = B.col(6) + 2 * B.col(0);
  const Mat A = B.transpose() * B;
  SemidefiniteLdlt factors;
  factors.analyse(sparse(A));
  factors.factorise(sparse(A), 1e-12);
  ASSERT_EQ(factors.dependent().size(), 3u);
  Vec known = Vec::LinSpaced(9, 1, -2);
  for (const int i : factors.dependent()) known(i) = 0;
  Vec x = A * known;
  factors.solve(x);
  EXPECT_LT((x - known).norm(), 1e-10);
}

// Points on a line whose second differences vanish, each row said twice: the softest of their singular values is (pi/n)^2, 1e-5, its
// square as small as the regularisation of shorter systems. Translation and rotation are left.
struct Line {
  static constexpr int n = 1000;
  std::vector<BodyBlock> bodies;
  Vec f;

  Line() {
    for (int k = 0; k < n; ++k) {
      BodyBlock body;
      body.v0 = k;
      body.M = Mat::Constant(1, 1, 1 + 0.5 * std::sin(double(k)));
      for (int twice = 0; twice < 2; ++twice)
        for (int row = std::max(0, k - 2); row <= std::min(k, n - 3); ++row) {
          body.rows.push_back(twice * (n - 2) + row);
          body.Gt.conservativeResize(1, Eigen::Index(body.rows.size()));
          body.Gt(0, body.Gt.cols() - 1) = row == k - 1 ? -2 : 1;
        }
      bodies.push_back(body);
    }
    f = Vec::NullaryExpr(n, [](Eigen::Index k) { return std::cos(0.37 * double(k)); });
  }
  Vec exact() const {  // a + b (k - n/2)
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d r = Eigen::Vector2d::Zero();
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector2d mode(1, k - n / 2);
      A += bodies[std::size_t(k)].M(0, 0) * mode * mode.transpose();
      r += f(k) * mode;
    }
    const Eigen::Vector2d ab = A.ldlt().solve(r);
    return Vec::NullaryExpr(n, [&](Eigen::Index k) { return ab(0) + ab(1) * double(k - n / 2); });
  }
};

TEST(LongChain, KeepsItsSoftDirectionsBesideRedundantRows) {
  const Line line;
  SparseMassKkt kkt;
  const int rows = 2 * (Line::n - 2);
  ASSERT_TRUE(kkt.factorise(line.bodies, rows, SparseMassKkt::Metric::mass));
  EXPECT_TRUE(kkt.redundant());
  Vec x, y;
  kkt.solve(line.bodies, line.f, Vec::Zero(rows), x, y);
  // Round-off of second differences, summed up twice along the line.
  EXPECT_LT((x - line.exact()).norm(), 1e-9 * line.exact().norm());
}

// What contradicts itself has no solution; the one of least squares is found as for shorter systems.
TEST(LongChain, BalancesRowsThatContradictEachOther) {
  Line line;
  SparseMassKkt kkt;
  const int rows = 2 * (Line::n - 2);
  ASSERT_TRUE(kkt.factorise(line.bodies, rows, SparseMassKkt::Metric::mass, 1e-3));
  Vec c = Vec::Zero(rows), x, y;
  c(10) = 1e-3;  // and 0 for its twin
  kkt.solve(line.bodies, Vec::Zero(Line::n), c, x, y);
  Vec kept = Vec::Zero(rows);
  add_rows_times(line.bodies, 1, x, kept);
  EXPECT_NEAR(kept(10), kept(10 + Line::n - 2), 1e-12);
}

}  // namespace
}  // namespace trammel::numerics
