// Which rows are independent, and what rates have beside those that follow from others.
#include "complementarity/shares/row_basis.hpp"

#include <cmath>

#include <gtest/gtest.h>

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
