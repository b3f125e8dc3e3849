// Rows that make two unknowns one, and which rows touch which bodies, by themselves.
#include "linear/bodies/merged_unknowns.hpp"

#include <gtest/gtest.h>

#include "linear/bodies/row_places.hpp"

namespace trammel::numerics {
namespace {

// Points of two coordinates each, and their parts of the rows of G.
std::vector<BodyBlock> points(const Mat& G, const std::vector<char>& constant = {}) {
  std::vector<BodyBlock> bodies(std::size_t(G.cols() / 2));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    BodyBlock& body = bodies[b];
    body.v0 = 2 * int(b);
    const auto columns = G.middleCols(body.v0, 2);
    for (int row = 0; row < int(G.rows()); ++row)
      if (!columns.row(row).isZero(0)) body.rows.push_back(row);
    body.Gt = columns(body.rows, Eigen::all).transpose();
    for (const int row : body.rows)
      if (!constant.empty()) body.constant.push_back(constant[std::size_t(row)]);
  }
  return bodies;
}

// Three points with equal x, said three times; what rows 3 and 4 say is no difference of two points.
Mat rows_of_three_points() {
  Mat G = Mat::Zero(5, 6);
  G(0, 0) = 2, G(0, 2) = -2;
  G(1, 2) = -0.5, G(1, 4) = 0.5;
  G(2, 0) = 1, G(2, 4) = -1;
  G(3, 1) = 1, G(3, 3) = 1;
  G(4, 0) = 1, G(4, 1) = -1;
  return G;
}

TEST(MergedUnknowns, AreThoseThatDifferencesHoldTogether) {
  MergedUnknowns merged;
  merged.find(points(rows_of_three_points()), 6, 5);
  EXPECT_EQ(merged.count(), 4);
  EXPECT_EQ(merged.idle(), 1);
  EXPECT_EQ(merged.of(0), merged.of(2));
  EXPECT_EQ(merged.of(0), merged.of(4));
  for (const int other : {1, 3, 5}) EXPECT_NE(merged.of(0), merged.of(other));
  EXPECT_NE(merged.of(1), merged.of(3));
  for (const int row : {0, 1, 2}) EXPECT_TRUE(merged.takes(row));
  for (const int row : {3, 4}) EXPECT_FALSE(merged.takes(row));
}

TEST(MergedUnknowns, AreFoundAmongTheFirstRowsOnlyAndAnewEachTime) {
  MergedUnknowns merged;
  merged.find(points(rows_of_three_points()), 6, 5);
  merged.find(points(rows_of_three_points()), 6, 1);
  EXPECT_EQ(merged.count(), 5);
  EXPECT_EQ(merged.idle(), 0);
  EXPECT_EQ(merged.of(0), merged.of(2));
  EXPECT_NE(merged.of(0), merged.of(4));
}

// x_j = X_u(j) + o_j solves the rows for every X, if the right side of the idle one agrees.
TEST(MergedUnknowns, DifferByTheirOffsets) {
  const Mat G = rows_of_three_points();
  MergedUnknowns merged;
  merged.find(points(G), 6, 5);
  const Vec c{{3, 0.7, 1.5 - 1.4, 0, 0}}, X{{0.3, -2, 5, 11}};
  Vec o, x(6);
  merged.offsets(c, o);
  for (int j = 0; j < 6; ++j) x[j] = X[merged.of(j)] + o[j];
  EXPECT_LE((G * x - c).head(3).lpNorm<Eigen::Infinity>(), 1e-14);
}

// r - G^T y is the sum of the forces at one of the unknowns that are merged and 0 at the others.
TEST(MergedUnknowns, HaveMultipliersThatCarryTheirForcesTogether) {
  const Mat G = rows_of_three_points();
  MergedUnknowns merged;
  merged.find(points(G), 6, 5);
  const Vec r{{1, 2, 4, 8, 16, 32}};
  Vec rest = r, y = Vec::Zero(5);
  merged.multipliers(rest, y);
  const Vec left = r - G.transpose() * y;
  EXPECT_EQ(left[0] + left[2] + left[4], 21);
  EXPECT_EQ((left.array() != 0).count(), 4);
  EXPECT_EQ(left[1], 2);
  EXPECT_EQ(left[3], 8);
  EXPECT_EQ(left[5], 32);
}

TEST(MergedUnknowns, HoldAsLongAsTheirRowsAreDifferences) {
  const std::vector<BodyBlock> before = points(rows_of_three_points());
  MergedUnknowns merged;
  merged.find(before, 6, 5);
  EXPECT_TRUE(merged.still_hold(before));
  const auto hold = [&](std::size_t body, Eigen::Index column, Eigen::Index at, double value) {
    std::vector<BodyBlock> bodies = before;
    bodies[body].Gt(at, column) = value;
    return merged.still_hold(bodies);
  };
  EXPECT_FALSE(hold(0, 0, 0, 2.5)) << "no longer the opposite";
  EXPECT_FALSE(hold(0, 0, 0, 0)) << "no longer an unknown of two";
  EXPECT_FALSE(hold(1, 1, 1, 1e-9)) << "a third unknown";
  EXPECT_TRUE(hold(1, 2, 1, 7)) << "row 3 merges nothing";
}

TEST(MergedUnknowns, OfConstantRowsAreNotLookedAtAgain) {
  std::vector<BodyBlock> bodies = points(rows_of_three_points(), {1, 1, 0, 1, 1});
  EXPECT_EQ(MergedUnknowns::count_constant_rows(bodies, 5), 2);
  EXPECT_EQ(MergedUnknowns::count_constant_rows(bodies, 1), 1);
  EXPECT_EQ(MergedUnknowns::count_constant_rows(points(rows_of_three_points()), 5), 0);
  MergedUnknowns merged;
  merged.find(bodies, 6, 5);
  bodies[0].Gt(0, 0) = 3;
  EXPECT_TRUE(merged.still_hold(bodies));
  bodies[0].Gt(0, 1) = 3;  // row 2
  EXPECT_FALSE(merged.still_hold(bodies));
}

TEST(MergedUnknowns, AreNoneIfNoneAreTaken) {
  std::vector<BodyBlock> bodies = points(rows_of_three_points());
  MergedUnknowns merged;
  merged.find(bodies, 6, 5);
  merged.take_none(6, 5);
  EXPECT_EQ(merged.count(), 6);
  EXPECT_EQ(merged.idle(), 0);
  for (int j = 0; j < 6; ++j) EXPECT_EQ(merged.of(j), j);
  for (int row = 0; row < 5; ++row) EXPECT_FALSE(merged.takes(row));
  Vec o;
  merged.offsets(Vec::Ones(5), o);
  EXPECT_EQ(o, Vec::Zero(6));
  bodies[0].Gt.setZero();
  EXPECT_TRUE(merged.still_hold(bodies));
}

std::vector<BodyBlock> bodies_with(const std::vector<std::vector<int>>& rows) {
  std::vector<BodyBlock> bodies(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) bodies[k].rows = rows[k];
  return bodies;
}

TEST(RowPlaces, AreTheSameIfEachBodyHasTheSameRows) {
  RowPlaces places;
  EXPECT_FALSE(places.are_of({}, 0)) << "nothing taken yet";
  for (int again = 0; again < 2; ++again) {
    places.take(bodies_with({{0, 1}, {}, {1, 2}}), 3);
    EXPECT_TRUE(places.are_of(bodies_with({{0, 1}, {}, {1, 2}}), 3));
    EXPECT_FALSE(places.are_of(bodies_with({{0, 1}, {}, {1, 2}}), 2));
    for (const auto& rows : std::vector<std::vector<std::vector<int>>>{{{0, 2}, {}, {1, 2}},
                                                                       {{0}, {1}, {1, 2}},
                                                                       {{0, 1}, {1, 2}},
                                                                       {{0, 1}, {}, {1, 2}, {}},
                                                                       {{0, 1}, {}},
                                                                       {{0, 1}, {}, {1}},
                                                                       {{0, 1}, {}, {1, 2, 3}},
                                                                       {}})
      EXPECT_FALSE(places.are_of(bodies_with(rows), 3)) << rows.size();
  }
  places.take(bodies_with({{4}}), 5);
  EXPECT_TRUE(places.are_of(bodies_with({{4}}), 5));
}

}  // namespace
}  // namespace trammel::numerics
