#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "model/model.hpp"

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

}  // namespace
}  // namespace trammel::model
