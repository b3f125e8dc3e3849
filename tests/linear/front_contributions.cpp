#include "linear/fronts/front_contributions.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace trammel::numerics {
namespace {

// Two rows between neighbours, the first of which never changes, as the masses never do.
std::vector<BodyBlock> three_bodies() {
  std::vector<BodyBlock> bodies(3);
  for (int i = 0; i < 3; ++i) {
    BodyBlock& body = bodies[std::size_t(i)];
    body.v0 = 2 * i;
    body.M = Eigen::Matrix2d{{3, 1}, {1, 2}};
    body.constant_mass = true;
  }
  bodies[0].rows = {0}, bodies[1].rows = {0, 1}, bodies[2].rows = {1};
  bodies[0].constant = {1}, bodies[1].constant = {1, 0}, bodies[2].constant = {0};
  bodies[0].Gt = Eigen::Vector2d(0.5, 1), bodies[2].Gt = Eigen::Vector2d(0.3, 0.7);
  bodies[1].Gt = Eigen::Matrix2d{{0.5, 0.3}, {1, 0.7}};
  return bodies;
}

struct Pieces {
  explicit Pieces(const std::vector<BodyBlock>& bodies) {
    layout.build(bodies, 2);
    pieces.build(layout, bodies);
    pieces.place_masses(layout, bodies);
  }
  // Of the body's column of G^T, -1: its mass.
  std::size_t source(int body, int column) const {
    for (std::size_t i = 0; i < layout.sources().size(); ++i) {
      const FrontLayout::Source& source = layout.sources()[i];
      if (source.body == body && (column < 0 ? source.row < 0 : source.row >= 0 && source.column == column)) return i;
    }
    ADD_FAILURE() << "no source of body " << body << ", column " << column;
    return 0;
  }
  const double* of(int body, int column) const { return pieces.of(source(body, column)); }
  const double* update(int body, int column, const std::vector<BodyBlock>& bodies) {
    const std::size_t i = source(body, column);
    return pieces.update(i, layout.sources()[i], bodies);
  }
  FrontLayout layout;
  FrontContributions pieces;
};

TEST(FrontContributions, KeepsConstantOnesOnceWhereAlike) {
  std::vector<BodyBlock> bodies = three_bodies();
  bodies[2].M(0, 0) = 4;
  const Pieces pieces(bodies);
  EXPECT_EQ(pieces.of(0, 0), pieces.of(1, 0));
  EXPECT_EQ(pieces.of(0, -1), pieces.of(1, -1));
  EXPECT_EQ(pieces.of(0, -1)[0], 3);
  EXPECT_EQ(pieces.of(2, -1)[0], 4);
}

TEST(FrontContributions, KeepsThoseThatChangeApartHoweverAlike) {
  const std::vector<BodyBlock> bodies = three_bodies();
  Pieces pieces(bodies);
  EXPECT_NE(pieces.update(1, 1, bodies), pieces.update(2, 0, bodies));
}

TEST(FrontContributions, TakesThoseThatChangeAnewAndConstantOnesOnce) {
  std::vector<BodyBlock> bodies = three_bodies();
  Pieces pieces(bodies);
  bodies[1].Gt *= 2, bodies[1].M *= 2;
  EXPECT_EQ(pieces.update(1, 0, bodies)[0], 0.5);
  EXPECT_EQ(pieces.update(1, 1, bodies)[0], 0.6);
  EXPECT_EQ(pieces.update(1, -1, bodies)[0], 3);
  EXPECT_EQ(pieces.update(2, 0, bodies)[0], 0.3);
}

TEST(FrontContributions, PlacesMassesOnceForALayoutAndAnewForAnother) {
  std::vector<BodyBlock> bodies = three_bodies();
  Pieces pieces(bodies);
  bodies[0].M(0, 0) = 7;
  pieces.pieces.place_masses(pieces.layout, bodies);
  EXPECT_EQ(pieces.of(0, -1)[0], 3) << "it was there";
  pieces.layout.build(bodies, 1);
  pieces.pieces.build(pieces.layout, bodies);
  pieces.pieces.place_masses(pieces.layout, bodies);
  EXPECT_EQ(pieces.of(0, -1)[0], 7);
  EXPECT_EQ(pieces.of(1, -1)[0], 3);
}

// An order by value would find it equal to any number, and hide it.
TEST(FrontContributions, DoesNotTakeAnythingForNotANumber) {
  std::vector<BodyBlock> bodies = three_bodies();
  bodies[0].Gt(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const Pieces pieces(bodies);
  EXPECT_TRUE(std::isnan(pieces.of(0, 0)[0]));
  EXPECT_EQ(pieces.of(1, 0)[0], 0.5);
}

}  // namespace
}  // namespace trammel::numerics
