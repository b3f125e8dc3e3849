// Least squares with x >= 0, by the conditions of optimality, and the linear complementarity problem of the friction
// polygon, by the conditions of the contact.
#include "complementarity/programs/nonnegative_least_squares.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "complementarity/programs/polyhedral_cone.hpp"

namespace trammel::complementarity {
namespace {

// x >= 0, B^T (d - B x) <= 0, and 0 where x is not.
void expect_least(const Mat& B, const Vec& d) {
  Vec x;
  const double missed = nonnegative_least_squares(B, d, x);
  ASSERT_EQ(x.size(), B.cols());
  const Vec residual = d - B * x;
  EXPECT_NEAR(missed, residual.norm(), 1e-12 * d.norm());
  const double little = 1e-11 * d.norm();
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    EXPECT_GE(x[j], 0);
    EXPECT_LE(B.col(j).dot(residual), little * B.col(j).norm());
    if (x[j] > 0) {
      EXPECT_NEAR(B.col(j).dot(residual), 0, little * B.col(j).norm());
    }
  }
}

TEST(NonnegativeLeastSquares, IsOptimalForColumnsOfAnySizeAndRank) {
  std::mt19937 random(95);
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const Eigen::Index m = 1 + Eigen::Index(random() % 8), n = 1 + Eigen::Index(random() % 12);
    Mat B = Mat::NullaryExpr(m, n, [&] { return any(random); });
    if (n > 2 && i % 2) B.col(n - 1) = B.col(0) + B.col(1);
    if (n > 3 && i % 3 == 0) B.col(2).setZero();
    if (n > 4 && i % 5 == 0) B.col(3) = 2 * B.col(4);
    for (Eigen::Index j = 0; j < n; ++j) B.col(j) *= std::pow(10, 3 * part(random));
    Vec d = Vec::NullaryExpr(m, [&] { return any(random); });
    d *= std::pow(10, 6 * part(random));
    expect_least(B, d);
    // In the cone of the columns: nothing is missed.
    const Vec inside = B * Vec::NullaryExpr(n, [&] { return std::max(0.0, part(random)); });
    Vec x;
    EXPECT_LE(nonnegative_least_squares(B, inside, x), 1e-11 * inside.norm());
  }
}

// Columns that are nearly parallel: many of them leave again before the end.
TEST(NonnegativeLeastSquares, IsOptimalForColumnsThatAreNearlyParallel) {
  std::mt19937 random(96);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Mat B = Mat::NullaryExpr(20, 30, [&] { return 1 + 0.1 * part(random); });
    expect_least(B, Vec::NullaryExpr(20, [&] { return 1 + 0.1 * part(random); }));
  }
}

TEST(NonnegativeLeastSquares, OfNothingAndOfNumbersThatAreNone) {
  Vec x;
  EXPECT_EQ(nonnegative_least_squares(Mat(2, 0), Vec{{3, 4}}, x), 5);
  EXPECT_EQ(x.size(), 0);
  EXPECT_EQ(nonnegative_least_squares(Mat::Identity(2, 2), Vec::Zero(2), x), 0);
  EXPECT_EQ(x, Vec::Zero(2));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(nonnegative_least_squares(Mat{{1, std::nan("")}}, Vec{{1.0}}, x), infinity);
  EXPECT_EQ(x, Vec::Zero(2));
  EXPECT_EQ(nonnegative_least_squares(Mat{{1, 2}}, Vec{{infinity}}, x), infinity);
}

// A block of mass 2 that a force pushes against a wall and along it.
struct Pushed {
  ContactPoint p{.normal = 0, .tangent = 1, .kind = ContactPoint::Tangent::resting, .coefficient = 0.5};
  Mat A = Mat::Identity(2, 2) / 2;

  Vec forces(const Vec& b, double compliance = 0, int sides = 8) const {
    const PolyhedralCone cone({p}, A, b, compliance, sides);
    Vec z, w;
    EXPECT_EQ(solve_lcp(cone.M(), cone.q(), z, w), LcpOutcome::solved);
    return cone.forces(z);
  }
};

TEST(PolyhedralCone, HoldsABlockAtAWallInThePlane) {
  const Pushed block;
  for (const double unit : {1e-6, 1.0, 1e6})
    for (const double sign : {-1.0, 1.0}) {
      const auto expect = [&](const Vec& b, const Vec& F) {
        EXPECT_NEAR((block.forces(unit * b) - unit * F).norm(), 0, 1e-7 * unit) << unit << ", " << b.transpose();
      };
      expect(Vec{{-3, 1 * sign}}, Vec{{6, -2 * sign}});  // sticks
      expect(Vec{{-3, 4 * sign}}, Vec{{6, -3 * sign}});  // slides
      expect(Vec{{1, 4 * sign}}, Vec{{0, 0}});           // leaves the wall
    }
}

TEST(PolyhedralCone, YieldsByItsComplianceRelativeToTheLargestEntryOfA) {
  const Pushed block;
  EXPECT_NEAR((block.forces(Vec{{-3, 1}}, 0.5) - Vec{{4, -4.0 / 3}}).norm(), 0, 1e-7);
}

TEST(PolyhedralCone, HasDirectionsAllAroundInSpace) {
  Pushed block;
  block.p.tangents = 2;
  block.A = Mat::Identity(3, 3) / 2;
  for (int k = 0; k < 6; ++k) {
    const double angle = std::acos(-1) / 3 * k;
    const Vec slip{{std::cos(angle), std::sin(angle)}};
    Vec b(3), slides(3), sticks(3);
    b << -3, 4 * slip;
    slides << 6, -3 * slip;  // along a direction of the hexagon, where it is the disk
    EXPECT_NEAR((block.forces(b, 0, 6) - slides).norm(), 0, 1e-7) << k;
    b << -3, slip;
    sticks << 6, -2 * slip;
    EXPECT_NEAR((block.forces(b, 0, 6) - sticks).norm(), 0, 1e-7) << k;
  }
}

TEST(PolyhedralCone, HoldsUnderAGivenNormalForce) {
  Pushed block;
  block.p.normal = -1, block.p.tangent = 0, block.p.given = 4;
  block.A = Mat{{0.5}};
  EXPECT_NEAR(block.forces(Vec{{3.0}})[0], -2, 1e-7);
  EXPECT_NEAR(block.forces(Vec{{-0.5}})[0], 1, 1e-7);
}

TEST(PolyhedralCone, CarriesTheFrictionOfASlidingContactAlong) {
  Pushed block;
  block.p.kind = ContactPoint::Tangent::sliding, block.p.ratio = {-0.25, 0};
  EXPECT_NEAR((block.forces(Vec{{-3, 1}}) - Vec{{6, -1.5}}).norm(), 0, 1e-7);
}

// a_n = N - T and T = p N: at p = 1 the stiffness is 0 but for round-off, and there is no solution.
TEST(PolyhedralCone, HasNoStiffnessAtPainlevesCriticalCoefficient) {
  Pushed block;
  block.p.kind = ContactPoint::Tangent::sliding, block.p.ratio = {1, 0};
  block.A = Mat{{0.3, -0.1 * 3}, {-0.1 * 3, 1}};
  EXPECT_EQ(PolyhedralCone({block.p}, block.A, Vec{{-1, 0}}, 0).M()(0, 0), 0);
  block.p.ratio = {0.999, 0};
  EXPECT_NEAR(PolyhedralCone({block.p}, block.A, Vec{{-1, 0}}, 0).M()(0, 0), 0.3 * 0.001, 1e-12);
}

}  // namespace
}  // namespace trammel::complementarity
