// Which rows are independent, and what rates have beside those that follow from others.
#include "complementarity/shares/row_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

// Rows (1, 0), (0, 1) and (cos x, sin x) of a unit mass.
Mat rows_at(double x) {
  const Mat G{{1, 0}, {0, 1}, {std::cos(x), std::sin(x)}};
  return G * G.transpose();
}

TEST(WellConditionedRows, LeaveOutWhatOthersNearlyImply) {
  const std::vector<Eigen::Index> first_and_last{0, 2};
  EXPECT_EQ(well_conditioned_rows(rows_at(1e-2), first_and_last, 1e-6).size(), 2u);
  EXPECT_EQ(well_conditioned_rows(rows_at(1e-4), first_and_last, 1e-6).size(), 1u);
  EXPECT_EQ(find_basis(rows_at(1e-4), first_and_last).basis.size(), 2u);
}

// Rows of small integers in a few coordinates, times lengths from 1 to 1000, and a last one that shares nothing with
// them but round-off, since the coordinates are turned.
Mat random_rows(std::mt19937& random, Eigen::Index rows, Eigen::Index coordinates) {
  std::uniform_real_distribution<double> part(0, 1);
  Mat G = Mat::Zero(rows + 1, coordinates + 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double length = std::pow(1000, part(random));
    for (Eigen::Index j = 0; j < coordinates; ++j) G(i, j) = length * (int(random() % 3) - 1);
  }
  G(rows, coordinates) = 20;
  const Vec normal = Vec::NullaryExpr(coordinates + 1, [&] { return part(random); }).normalized();
  return G - 2 * (G * normal) * normal.transpose();
}

Eigen::Index rank_of(const Mat& rows) {
  Eigen::FullPivLU<Mat> lu(rows);
  lu.setThreshold(1e-10);
  return lu.rank();
}

TEST(RowBasis, HoldsAsManyRowsAsTheRankFromWhichTheOthersFollow) {
  std::mt19937 random(71);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Eigen::Index rows = 1 + Eigen::Index(random() % 8), coordinates = 1 + i % 5;
    const Mat G = random_rows(random, rows, coordinates);
    const Mat A = G * G.transpose();
    std::vector<Eigen::Index> first, others;
    for (Eigen::Index k = 0; k <= rows; ++k) (random() % 2 ? first : others).push_back(k);
    const RowBasis found = find_basis(A, first, others);
    EXPECT_EQ(Eigen::Index(found.basis.size()), rank_of(G));
    std::vector<Eigen::Index> all = found.basis, every(std::size_t(rows + 1));
    all.insert(all.end(), found.implied.begin(), found.implied.end());
    const Mat missed = G(found.implied, Eigen::all) - found.K * G(found.basis, Eigen::all);
    ASSERT_EQ(found.K.rows(), Eigen::Index(found.implied.size()));
    for (Eigen::Index k = 0; k < missed.rows(); ++k) {
      EXPECT_LE(missed.row(k).norm(), 1e-8 * G.row(found.implied[std::size_t(k)]).norm());
      for (Eigen::Index j = 0; j < found.K.cols(); ++j)
        if (found.basis[std::size_t(j)] == rows) {
          EXPECT_EQ(found.K(k, j), 0);
        }
    }
    // E F = lambda are the resultants of forces along all rows, G^T F = G_basis^T lambda.
    EXPECT_LE((G(found.basis, Eigen::all).transpose() * found.resultants() - G(all, Eigen::all).transpose()).norm(),
              1e-8 * G.norm());
    std::sort(all.begin(), all.end());
    std::iota(every.begin(), every.end(), Eigen::Index(0));
    EXPECT_EQ(all, every);
    // No row of the others is in the basis in the place of one of the first.
    const auto from_first = std::count_if(found.basis.begin(), found.basis.end(), [&](Eigen::Index k) {
      return std::find(first.begin(), first.end(), k) != first.end();
    });
    EXPECT_EQ(from_first, first.empty() ? 0 : rank_of(G(first, Eigen::all)));
    for (const Eigen::Index k : found.implied) EXPECT_TRUE(follows(A, found.basis, k));
    EXPECT_FALSE(follows(A, {0}, rows));
  }
}

TEST(RowBasis, IsOneOfTwoParallelRows) {
  const Mat G{{3, 4}, {6, 8}};
  const RowBasis found = find_basis(G * G.transpose(), {0, 1});
  EXPECT_EQ(found.basis, std::vector<Eigen::Index>{0});
  EXPECT_NEAR(found.K(0, 0), 2, 1e-15);
}

// Shares of rows of one length: 2e-9, or below 1e-9 round-off. The rows are longer or shorter.
TEST(RowBasis, SharesDownToABillionthOfTheRowsLengths) {
  for (const double longer : {1e-3, 1.0, 1e3})
    for (const double implied : {1e-3, 1.0, 1e3})
      for (const auto& [share, kept] : {std::pair(2e-9, true), std::pair(0.5e-9, false)}) {
        const Mat G{{1, 0}, {0, longer}, {implied, implied * share}};
        const RowBasis found = find_basis(G * G.transpose(), {0, 1}, {2});
        ASSERT_EQ(found.implied, std::vector<Eigen::Index>{2});
        for (std::size_t k = 0; k < 2; ++k) {
          const double expected = found.basis[k] == 0 ? implied : kept ? implied * share / longer : 0;
          EXPECT_NEAR(found.K(0, Eigen::Index(k)), expected, 1e-14 * implied / longer + 1e-15 * implied)
              << longer << " " << implied << " " << share;
        }
      }
}

TEST(RowBasis, TakesTheRowThatTheOthersImplyLeast) {
  const RowBasis found = find_basis(rows_at(1e-4), {0, 2, 1});
  EXPECT_EQ(found.basis, (std::vector<Eigen::Index>{0, 1}));
  EXPECT_NEAR(found.K(0, 0), 1, 1e-8);
  EXPECT_NEAR(found.K(0, 1), 1e-4, 1e-12);
}

TEST(RatesBesideABasis, AreRoundOffWhereAMotionGivesThem) {
  const double x = 0.3;
  const Vec v{{2, -5}}, rates{{v[0], v[1], std::cos(x) * v[0] + std::sin(x) * v[1]}};
  EXPECT_NEAR(beside_basis(rows_at(x), {0, 1}, {2}, rates)[0], 0, 1e-15);
  const Vec moved{{v[0], v[1], rates[2] + 1e-9}};
  EXPECT_NEAR(beside_basis(rows_at(x), {0, 1}, {2}, moved)[0], 1e-9, 1e-15);
}

TEST(RatesBesideABasis, AreInfiniteWhereTheRowDoesNotFollow) {
  EXPECT_TRUE(std::isinf(beside_basis(rows_at(0.3), {0}, {2}, Vec{{1, 0, 1}})[0]));
  EXPECT_TRUE(std::isinf(beside_basis(rows_at(0.3), {}, {2}, Vec{{1, 0, 1}})[0]));
  EXPECT_EQ(beside_basis(rows_at(0.3), {0}, {}, Vec{{1, 0, 1}}).size(), 0);
  // Whatever the units of the rates: rows of length 1e-3 and 1e3.
  for (const double size : {1e-3, 1e3})
    EXPECT_TRUE(std::isinf(beside_basis(size * size * rows_at(1e-5), {0}, {2}, Vec{{1, 0, 1}})[0])) << size;
}

// The third row turns away from the first by less than round-off of A shows; a motion along the second row does show.
TEST(RatesBesideABasis, TellASlowMotionFromADrift) {
  const double x = 1e-7;
  const double drift = 1e-7, speed = 1;
  EXPECT_NEAR(beside_basis(rows_at(x), {0}, {2}, Vec{{drift, 0, drift}})[0], 0, 1e-20);
  EXPECT_NEAR(beside_basis(rows_at(x), {0}, {2}, Vec{{0, speed, x * speed}})[0], x * speed, 1e-14);
}

}  // namespace
}  // namespace trammel::complementarity
