#include "linear/sparse/dependent_rows.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace trammel::numerics {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

SparseRows sparse(const Eigen::MatrixXd& G) {
  return G.sparseView(1, 0);
}

TEST(DependentRows, AreSumsOfRowsBefore) {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(9, 12);
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 4; ++j) G(i, (5 * i + 3 * j) % 12) += std::sin(1.0 + i + 10 * j);
  G.row(3) = 2 * G.row(0) - 1e6 * G.row(2);
  G.row(5) = G.row(4) + G.row(1);
  G.row(8).setZero();
  EXPECT_THAT(dependent_rows(sparse(G), 1e-7), ElementsAre(3, 5, 8));
}

TEST(DependentRows, AreAllThatAreMoreThanTheColumns) {
  Eigen::MatrixXd G(5, 3);
  G << 0, 0, 1, 1, 2, 3, 0, 0, 2, 1, 2, 4, 1, -1, 0;
  EXPECT_THAT(dependent_rows(sparse(G), 1e-7), ElementsAre(2, 3));
}

TEST(DependentRows, AreFoundByWhatIsLeftOfTheirLength) {
  Eigen::MatrixXd G(2, 2);
  G << 1e6, 0, 1e-3, 1e-9;
  EXPECT_THAT(dependent_rows(sparse(G), 1e-7), IsEmpty());
  EXPECT_THAT(dependent_rows(sparse(G), 1e-5), ElementsAre(1));
}

// Whichever column comes first.
TEST(DependentRows, AreThoseAlongTheOthersButForLessThanTheTolerance) {
  for (const double off : {1e-15, 1e-12, 1e-9, 1e-6})
    for (const int column : {0, 1}) {
      Eigen::MatrixXd G(3, 2);
      G.col(column) << off, 0, 1;
      G.col(1 - column) << 1, 1, 0;
      EXPECT_THAT(dependent_rows(sparse(G), 1e-7), ElementsAre(off > 1e-7 ? 2 : 1)) << off;
    }
}

// Differences of neighbours, with the sum around a ring in the middle. Its rows together are as soft as 2 pi/n.
TEST(DependentRows, OfALongRingAreTheLastRowAlone) {
  constexpr int n = 20000;
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 1.0);
    entries.emplace_back(i, (i + 1) % n, -1.0);
  }
  entries.emplace_back(n, n / 2, 1.0);
  SparseRows G(n + 1, n);
  G.setFromTriplets(entries.begin(), entries.end());
  EXPECT_THAT(dependent_rows(G, 1e-7), ElementsAre(n - 1));
}

}  // namespace
}  // namespace trammel::numerics
