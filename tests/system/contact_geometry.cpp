#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "model/model.hpp"
#include "particle.hpp"
#include "system/contact_geometry/contact_geometry.hpp"

namespace trammel::model {
namespace {

// A point on a circle, and a plane on a frame that turns and moves: both given as functions of time, so that gap and
// its rates can be compared with differences.
Motion moving_point(double t) {
  Motion m;
  m.x = Eigen::Vector2d(std::cos(2 * t), 1 + std::sin(3 * t));
  m.R.setIdentity(2, 2);
  m.V = Eigen::Vector3d(-2 * std::sin(2 * t), 3 * std::cos(3 * t), 0);
  m.bias = Eigen::Vector3d(-4 * std::cos(2 * t), -9 * std::sin(3 * t), 0);
  return m;
}

Motion turning_frame(double t) {
  Motion m;
  const double angle = 0.3 + t * t;
  m.x = Eigen::Vector2d(0.1 * t, std::sin(t));
  m.angle = angle;
  m.R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  m.V = Eigen::Vector3d(0.1, std::cos(t), 2 * t);
  m.bias = Eigen::Vector3d(0, -std::sin(t), 2);
  return m;
}

Rows rows_at(double t) {
  Rows rows;
  rows.resize(2, Space::planar);
  contact_rows({Eigen::Vector2d(0.2, -0.1), Eigen::Vector2d(0.6, 0.8)}, moving_point(t), turning_frame(t), true, rows);
  return rows;
}

double rate_at(double t, int row) {
  const Rows rows = rows_at(t);
  return rows.H_A.row(row).dot(moving_point(t).V) + rows.H_B.row(row).dot(turning_frame(t).V);
}

constexpr double s = 1e-6;  // central differences: 1e-12 truncation, 1e-10 round-off

TEST(PointOnPlane, GapRateIsTheDerivativeOfTheGap) {
  EXPECT_NEAR(rate_at(0.7, 0), (rows_at(0.7 + s).g(0) - rows_at(0.7 - s).g(0)) / (2 * s), 1e-8);
}

TEST(PointOnPlane, GammaMakesTheGapAcceleration) {
  const Rows rows = rows_at(0.7);
  const double acceleration =
      rows.H_A.row(0).dot(moving_point(0.7).bias) + rows.H_B.row(0).dot(turning_frame(0.7).bias) - rows.gamma(0);
  EXPECT_NEAR(acceleration, (rate_at(0.7 + s, 0) - rate_at(0.7 - s, 0)) / (2 * s), 1e-7);
}

TEST(PointOnPlane, SlipVelocityIsThatOfThePointOverThePlane) {
  // The point's velocity less that of the plane's material under it, along the tangent.
  const Motion A = moving_point(0.7), B = turning_frame(0.7);
  const Eigen::Vector2d d = A.x - B.x, swept(-B.V(2) * d(1), B.V(2) * d(0));
  const Eigen::Vector2d n = B.R * Eigen::Vector2d(0.6, 0.8), tangent(n(1), -n(0));
  EXPECT_NEAR(rate_at(0.7, 1), tangent.dot(A.V.head<2>() - B.V.head<2>() - swept), 1e-14);
}

// In space: the plane turns about an axis that is not its normal.
Motion tumbling_frame(double t) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized();
  Motion m;
  m.x = Eigen::Vector3d(0.1 * t, std::sin(t), 0);
  m.R = Eigen::AngleAxisd(0.3 + t * t, axis).toRotationMatrix();
  m.V = (Vec6(6) << 0.1, std::cos(t), 0, 2 * t * axis).finished();
  m.bias = (Vec6(6) << 0, -std::sin(t), 0, 2 * axis).finished();
  return m;
}

Motion point_in_space(double t) {
  Motion m;
  m.x = Eigen::Vector3d(std::cos(2 * t), 1 + std::sin(3 * t), t * t);
  m.R.setIdentity(3, 3);
  m.V = (Vec6(6) << -2 * std::sin(2 * t), 3 * std::cos(3 * t), 2 * t, 0, 0, 0).finished();
  m.bias = (Vec6(6) << -4 * std::cos(2 * t), -9 * std::sin(3 * t), 2, 0, 0, 0).finished();
  return m;
}

const Eigen::Vector3d normal_in_space(0.48, 0.6, 0.64);

Rows rows_in_space(double t) {
  Rows rows;
  rows.resize(3, Space::spatial);
  contact_rows({Eigen::Vector3d(0.2, -0.1, 0.3), normal_in_space}, point_in_space(t), tumbling_frame(t), true, rows);
  return rows;
}

Vec rates_in_space(double t) {
  const Rows rows = rows_in_space(t);
  return rows.H_A * point_in_space(t).V + rows.H_B * tumbling_frame(t).V;
}

TEST(PointOnPlane, TangentsAreFixedInThePlanesBody) {
  const Mat3 first =
      tumbling_frame(0.7).R.transpose() * Mat3(rows_in_space(0.7).H_A.bottomLeftCorner(2, 3).transpose());
  const Mat3 later =
      tumbling_frame(2.1).R.transpose() * Mat3(rows_in_space(2.1).H_A.bottomLeftCorner(2, 3).transpose());
  EXPECT_LT((first - later).norm(), 1e-14);
}

TEST(PointOnPlane, TangentsAndNormalAreOrthonormalInSpace) {
  const Mat3 axes = rows_in_space(0.7).H_A.leftCols(3);
  EXPECT_LT((axes * axes.transpose() - Mat3(Eigen::Matrix3d::Identity())).norm(), 1e-14);
}

// A ball around the point, which spins.
TEST(PointOnPlane, GammaMakesTheAccelerationsOfABallsGapAndSlipInSpace) {
  PointOnPlane plane(Eigen::Vector3d(0.2, -0.1, 0.3), normal_in_space);
  plane.radius = 0.4;
  const auto spinning = [](double t) {
    Motion m = point_in_space(t);
    m.V.tail(3) << std::sin(t), t * t, 2;
    m.bias.tail(3) << std::cos(t), 2 * t, 0;
    return m;
  };
  const auto rows_of = [&](double t) {
    Rows rows;
    rows.resize(3, Space::spatial);
    contact_rows(plane, spinning(t), tumbling_frame(t), true, rows);
    return rows;
  };
  const auto rates = [&](double t) -> Vec {
    const Rows rows = rows_of(t);
    return rows.H_A * spinning(t).V + rows.H_B * tumbling_frame(t).V;
  };
  const Rows rows = rows_of(0.7);
  const Vec acceleration = rows.H_A * spinning(0.7).bias + rows.H_B * tumbling_frame(0.7).bias - rows.gamma;
  EXPECT_LT((acceleration - (rates(0.7 + s) - rates(0.7 - s)) / (2 * s)).norm(), 1e-7);
}

TEST(PointOnPlane, GammaMakesTheAccelerationsOfGapAndSlipInSpace) {
  const Rows rows = rows_in_space(0.7);
  const Vec acceleration = rows.H_A * point_in_space(0.7).bias + rows.H_B * tumbling_frame(0.7).bias - rows.gamma;
  EXPECT_LT((acceleration - (rates_in_space(0.7 + s) - rates_in_space(0.7 - s)) / (2 * s)).norm(), 1e-7);
}

// The contract of every pairing with rows, with two particles at q, which move with v, and forces F along the rows.
class Pairing : public testing::Test {
 protected:
  Pairing() {
    test::add_particle(model, "one", 1, {0.7, 1.3}, {0.4, -1.1});
    test::add_particle(model, "two", 2, {-0.2, 0.5}, {1.7, 0.6});
    model.lay_out();
    markers = std::make_unique<MarkerMotions>(model, site);
    q = Vec{{0.7, 1.3, -0.2, 0.5}}, v = Vec{{0.4, -1.1, 1.7, 0.6}};
    entry.A = {0, 0}, entry.B = {1, 0};
  }
  void limit_from(double side) {
    entry.limit.emplace();
    entry.limit->joint = std::make_unique<test::Rod>(0.9);
    entry.limit->markers = {entry.A, entry.B};
    entry.limit->side = side;
  }
  Rows rows_at(const Vec& q_at) {
    Rows rows;
    rows.resize(n, Space::planar);
    markers->new_point();
    geometry->rows({0, q_at, v, ++number}, rows);
    return rows;
  }
  Vec force_at(const Vec& q_at) {
    const Rows rows = rows_at(q_at);
    Vec Q = Vec::Zero(4);
    for (int k = 0; k < 2; ++k)
      markers->add_wrench(geometry->slots()[std::size_t(k)], rows.H(k).transpose() * F.head(n), 1, Q);
    return Q;
  }
  void expect_exact_derivatives() {
    geometry = make_contact_geometry(model, entry, *markers);
    const Rows rows = rows_at(q);
    const Vec change = (rows_at(q + s * v).g - rows_at(q - s * v).g) / (2 * s);
    Vec rate = rows.g_t;
    for (int k = 0; k < 2; ++k) rate += rows.H(k) * markers->motion(geometry->slots()[std::size_t(k)], 0, q, v).V;
    EXPECT_LT((rate - change).norm(), 1e-8);
    Mat by_differences(4, 4), S = Mat::Zero(4, 4);
    for (int j = 0; j < 4; ++j) {
      const Vec dq = s * Vec::Unit(4, j);
      by_differences.col(j) = (force_at(q + dq) - force_at(q - dq)) / (2 * s);
    }
    const Rows again = rows_at(q);
    Matrix onto = Matrix::onto(S);
    geometry->add_reaction_tangent({0, q, v, number}, again, F, 3, onto);
    EXPECT_LT((S - 3 * by_differences).norm(), 1e-7);
    tangent = S;
  }

  Model model;
  CallSite site;
  std::unique_ptr<MarkerMotions> markers;
  ContactEntry entry;
  std::unique_ptr<ContactGeometry> geometry;
  Vec q, v;
  Eigen::Vector3d F{2.3, -0.8, 0};
  int n = 1;
  long long number = 0;
  Mat tangent;
};

TEST_F(Pairing, OfALimitHasExactDerivativesFromBothSides) {
  limit_from(1);
  expect_exact_derivatives();
  const Mat above = tangent;
  const double gap = rows_at(q).g(0);
  entry.limit->side = -1;
  expect_exact_derivatives();
  EXPECT_EQ(rows_at(q).g(0), -gap);
  EXPECT_GT(above.norm(), 1);  // the row turns with the rod: 3 F / L in size
  EXPECT_LT((tangent + above).norm(), 1e-14 * above.norm());
}

TEST_F(Pairing, OfAMarkerAndAPlaneHasExactDerivativesAlongTheTangentToo) {
  entry.geometry = PointOnPlane(Eigen::Vector2d(0.1, -0.3), Eigen::Vector2d(0.6, 0.8));
  n = 2;
  expect_exact_derivatives();
  EXPECT_EQ(geometry->tangents(), 1);
  EXPECT_FALSE(geometry->rolls());
}

}  // namespace
}  // namespace trammel::model
