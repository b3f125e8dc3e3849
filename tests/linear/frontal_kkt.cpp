// Elimination front by front: unique accelerations of long trusses, whatever their softness and redundancy.
#include <cmath>

#include <gtest/gtest.h>

#include "linear/fronts/frontal_kkt.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse_mass_kkt.hpp"
#include "trusses.hpp"

namespace trammel::numerics {
namespace {

using test::Truss;

struct Pose {
  double theta, theta_dot;
};
constexpr Pose poses[] = {{30 * test::pi / 180, 0}, {55 * test::pi / 180, 0.7}, {80 * test::pi / 180, -0.4}};

// In the largest norm, of the largest acceleration.
double error_of(const Truss& truss) {
  SparseMassKkt kkt;
  EXPECT_TRUE(kkt.factorise(truss.bodies, truss.rows, SparseMassKkt::Metric::mass));
  Vec x, y;
  kkt.solve(truss.bodies, truss.b, truss.c, x, y);
  return (x - truss.exact).lpNorm<Eigen::Infinity>() / truss.exact.lpNorm<Eigen::Infinity>();
}

int dependent_rows(const Truss& truss) {
  FrontalKkt kkt;
  EXPECT_TRUE(kkt.factorise(truss.bodies, truss.rows, false, rank_tolerance_at(0)));
  return kkt.dependent();
}

// The softest singular value falls with n^-2, its square, which a complement of masses would see, with n^-4: 1e-13
// here.
TEST(LongMast, HasTheAccelerationsOfItsExactModel) {
  for (const Pose& pose : poses) EXPECT_LT(error_of(Truss::mast(1000, pose.theta, pose.theta_dot)), 1e-10);
}

Vec accelerations_by_fronts(const Truss& truss, const Vec& b, const Vec& c) {
  FrontalKkt kkt;
  EXPECT_TRUE(kkt.factorise(truss.bodies, truss.rows, false, rank_tolerance_at(0)));
  Vec x, y;
  EXPECT_TRUE(kkt.solve(truss.bodies, b, c, x, y));
  return x;
}

// A force on one point, 1e4 to 1e6 times as much as its accelerations ask for: they are lost in the complement's
// round-off, which a mean of eigenvalues alone does not show.
TEST(LongMast, HasTheAccelerationsOfFrontsUnderASingleForce) {
  for (const int units : {126, 130, 200, 250})
    for (const double degrees : {60, 75, 80}) {
      const Truss mast = Truss::mast(units, degrees * test::pi / 180, 0);
      for (const Eigen::Index at : {mast.b.size() - 1, mast.b.size() - 3}) {
        const Vec b = Vec::Unit(mast.b.size(), at), c = Vec::Zero(mast.rows);
        const Vec by_fronts = accelerations_by_fronts(mast, b, c);
        SparseMassKkt kkt;
        ASSERT_TRUE(kkt.factorise(mast.bodies, mast.rows, SparseMassKkt::Metric::mass));
        Vec x, y;
        kkt.solve(mast.bodies, b, c, x, y);
        EXPECT_LT((x - by_fronts).lpNorm<Eigen::Infinity>(), 1e-9 * by_fronts.lpNorm<Eigen::Infinity>())
            << units << " units at " << degrees << " degrees, force " << at;
      }
    }
}

// Factors of a pose too far off for corrections to come closer give way to fronts of the pose at hand.
TEST(LongMast, IsNotLedAstrayByFactorsOfAnotherPose) {
  for (const double away : {1e-2, 1e-3, 1e-4}) {
    const Truss before = Truss::mast(130, 1.31, 0), mast = Truss::mast(130, 1.31 + away, 0);
    SparseMassKkt kkt;
    ASSERT_TRUE(kkt.factorise(before.bodies, before.rows, SparseMassKkt::Metric::mass));
    Vec x, y;
    kkt.solve(mast.bodies, mast.b, mast.c, x, y);
    EXPECT_LT((x - mast.exact).lpNorm<Eigen::Infinity>(), 1e-9 * mast.exact.lpNorm<Eigen::Infinity>()) << away;
  }
}

TEST(LongPrismaticMast, HasTheAccelerationsOfItsExactModel) {
  for (const Pose& pose : poses) EXPECT_LT(error_of(Truss::prismatic_mast(300, pose.theta, pose.theta_dot)), 1e-10);
}

// Rounding of the coordinates moves the rows of a hoop by eps n, and its softest singular value falls with n^-3.
TEST(LargeHoop, HasTheAccelerationsOfItsExactModel) {
  for (const Pose& pose : poses) EXPECT_LT(error_of(Truss::hoop(150, pose.theta, pose.theta_dot)), 1e-9);
}

// Fronts contradict each other, and springs take the rows' place. Rounding of the coordinates, 5e-14, turns a side by a
// few times that of the 2e-3 between neighbours.
TEST(VeryLargeHoop, HasTheAccelerationsOfItsExactModelByRowsAsSprings) {
  for (const Pose& pose : poses) EXPECT_LT(error_of(Truss::hoop(3000, pose.theta, pose.theta_dot)), 5e-11);
}

// Rows that contradict each other a little may leave a front no mass at all; springs take over there too.
TEST(LargeHoop, GoesOnBySpringsWhereFrontsCannot) {
  for (const Pose& pose : poses) EXPECT_LT(error_of(Truss::hoop(1500, pose.theta, pose.theta_dot)), 5e-11);
}

// Folded and at rest accelerations are small beside what the springs' solutions round.
TEST(VeryLargeHoop, HasTheAccelerationsOfItsExactModelWhereItIsFolded) {
  EXPECT_LT(error_of(Truss::hoop(10'000, 85 * test::pi / 180, 0)), 2e-10);
}

// Between those that fronts hold and those whose fronts contradict each other for all to see, springs take over by what
// rows miss. A mast's rows are missed by nothing but their own round-off, and springs would leave its softest
// directions free.
TEST(Hoops, OfAnySizeHaveTheAccelerationsOfTheirExactModel) {
  for (const int bays : {200, 400, 600, 850, 1000, 1200})
    for (const double degrees : {85, 80, 70, 50, 26})
      for (const double rate : {0.0, 0.7, -0.4})
        EXPECT_LT(error_of(Truss::hoop(bays, degrees * test::pi / 180, rate)), 1e-9)
            << bays << " bays at " << degrees << " degrees, " << rate << " rad/s";
}

TEST(FrontalKkt, CountsTheDependentRowsOfEachTruss) {
  for (const Pose& pose : poses) {
    EXPECT_EQ(dependent_rows(Truss::mast(100, pose.theta, pose.theta_dot)), 0);
    EXPECT_EQ(dependent_rows(Truss::prismatic_mast(100, pose.theta, pose.theta_dot)), 6 * 100 - 2);
    EXPECT_EQ(dependent_rows(Truss::hoop(100, pose.theta, pose.theta_dot)), 100 + 7);
  }
}

void expect_equations(const Truss& truss, bool identity, const Vec& b, const Vec& c, const Vec& x, const Vec& y,
                      double of_forces = 1e-10) {
  Vec force = b, missed = c;
  add_rows_times(truss.bodies, -1, x, missed);
  if (identity)
    force -= x;
  else
    add_mass_times(truss.bodies, -1, x, force);
  add_rows_force(truss.bodies, -1, y, force);
  EXPECT_LT(missed.norm(), 1e-10 * x.norm());
  EXPECT_LT(force.norm(), of_forces * y.norm());
}

// Also the multipliers, those of merged unknowns among them, and right sides that are not zero between merged ones.
TEST(FrontalKkt, SatisfiesTheEquationsForAnyRightSide) {
  const Truss truss = Truss::mast(20, 1, 0);
  const Vec b = Vec::NullaryExpr(truss.b.size(), [](Eigen::Index i) { return std::sin(1.0 + 3.0 * double(i)); });
  const Vec c = Vec::NullaryExpr(truss.rows, [](Eigen::Index i) { return std::cos(0.7 * double(i)); });
  for (const bool identity : {false, true}) {
    FrontalKkt kkt;
    ASSERT_TRUE(kkt.factorise(truss.bodies, truss.rows, identity, rank_tolerance_at(0)));
    Vec x, y;
    EXPECT_TRUE(kkt.solve(truss.bodies, b, c, x, y));
    expect_equations(truss, identity, b, c, x, y);
  }
}

// The prismatic mast has dependent rows, which springs need not find.
TEST(FrontalKkt, SatisfiesTheEquationsByRowsAsSprings) {
  const Truss truss = Truss::prismatic_mast(3, 1, 0.3);
  for (const bool identity : {false, true}) {
    FrontalKkt kkt;
    const double eps = kkt.factorise_springs(truss.bodies, truss.rows, identity, 1e-7);
    ASSERT_GT(eps, 0);
    Vec x, y;
    kkt.solve_springs(truss.bodies, eps, truss.b, truss.c, x, y);
    expect_equations(truss, identity, truss.b, truss.c, x, y, 1e-9);  // springs of 1e7 round so much
  }
}

TEST(FrontalKkt, FollowsPinsThatBecomeOtherRows) {
  Truss truss = Truss::mast(6, 1, 0.3);
  FrontalKkt kkt;
  ASSERT_TRUE(kkt.factorise(truss.bodies, truss.rows, false, rank_tolerance_at(0)));
  // A pin becomes a row between more unknowns than two.
  BodyBlock& body = truss.bodies[3];
  body.Gt(1, body.Gt.cols() - 1) += 0.25;
  ASSERT_TRUE(kkt.factorise(truss.bodies, truss.rows, false, rank_tolerance_at(0)));
  Vec x, y, missed = truss.c;
  EXPECT_TRUE(kkt.solve(truss.bodies, truss.b, truss.c, x, y));
  add_rows_times(truss.bodies, -1, x, missed);
  EXPECT_LT(missed.norm(), 1e-11 * x.norm());
}

// Rows of pins and masses, once these are asked for.
TEST(FrontalKkt, FollowsWhatChangesBesideWhatNeverDoes) {
  Truss before = Truss::mast(20, 1, 0.3), truss = Truss::mast(20, 1.1, 0.3);
  for (std::size_t k = 0; k < truss.bodies.size(); ++k) {
    BodyBlock& body = truss.bodies[k];
    body.constant_mass = true;
    for (Eigen::Index i = 0; i < body.Gt.cols(); ++i)
      body.constant.push_back(body.Gt.col(i) == before.bodies[k].Gt.col(i));
    before.bodies[k].constant_mass = true;
    before.bodies[k].constant = body.constant;
    before.bodies[k].M.setZero();
  }
  FrontalKkt kkt, fresh;
  ASSERT_TRUE(kkt.factorise(before.bodies, before.rows, true, rank_tolerance_at(0)));
  ASSERT_TRUE(fresh.factorise(truss.bodies, truss.rows, false, rank_tolerance_at(0)));
  Vec x, y, x_fresh, y_fresh;
  ASSERT_TRUE(fresh.solve(truss.bodies, truss.b, truss.c, x_fresh, y_fresh));
  for (int twice = 0; twice < 2; ++twice) {
    ASSERT_TRUE(kkt.factorise(truss.bodies, truss.rows, false, rank_tolerance_at(0)));
    ASSERT_TRUE(kkt.solve(truss.bodies, truss.b, truss.c, x, y));
    EXPECT_EQ(x, x_fresh);
    EXPECT_EQ(y, y_fresh);
  }
}

// Of neighbours: the lists of rows {0} {} and {} {0} are the same one behind the other.
TEST(FrontalKkt, FollowsARowThatMovesToTheNextBody) {
  FrontalKkt kkt;
  for (const int held : {0, 1}) {
    std::vector<BodyBlock> bodies(2);
    for (int k = 0; k < 2; ++k) {
      bodies[std::size_t(k)].v0 = k;
      bodies[std::size_t(k)].M = Mat::Ones(1, 1);
      bodies[std::size_t(k)].Gt = Mat::Ones(1, k == held);
      bodies[std::size_t(k)].rows.assign(k == held, 0);
    }
    ASSERT_TRUE(kkt.factorise(bodies, 1, false, rank_tolerance_at(0)));
    Vec x, y;
    ASSERT_TRUE(kkt.solve(bodies, Vec::Ones(2), Vec::Zero(1), x, y));
    EXPECT_EQ(x, Vec(Vec::Unit(2, 1 - held)));
    EXPECT_EQ(y, Vec(Vec::Ones(1)));
  }
}

// Points on a line whose second differences vanish, each row said twice: the softest of their singular values is
// (pi/n)^2, 1e-5, its square as small as the regularisation of shorter systems. Translation and rotation are left.
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
  // All rows but the two can hold, and these miss by half each.
  Vec balanced = Vec::Zero(rows);
  balanced(10) = balanced(10 + Line::n - 2) = 5e-4;
  EXPECT_LT((kept - balanced).lpNorm<Eigen::Infinity>(), 1e-9);
}

}  // namespace
}  // namespace trammel::numerics
