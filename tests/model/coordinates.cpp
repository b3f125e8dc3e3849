#include "model/coordinates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trammel::model {
namespace {

const Coordinates::Part rotation = Coordinates().then_rotation().parts()[0];
const Vec q0 = (Vec(4) << 0.5, 0.5, -0.5, 0.5).finished();

TEST(Rotation, DifferenceUndoesRetract) {
  for (const double size : {1e-12, 1e-6, 0.1, 3.0}) {
    const Vec dq = size * Eigen::Vector3d(1, -2, 2) / 3;
    Vec q1(4), back(3);
    retract(rotation, q0.data(), dq.data(), q1.data());
    difference(rotation, q1.data(), q0.data(), back.data());
    // The quaternion holds the angle to eps; its logarithm near pi amplifies that by 1/cos(1.5) = 14.
    EXPECT_LT((back - dq).norm(), 2e-14 * std::max(1.0, size)) << size;
  }
}

TEST(Rotation, RateIsTheDerivativeOfRetract) {
  const Vec omega = Eigen::Vector3d(0.3, -0.7, 1.1);
  const double s = 1e-6;
  Vec plus(4), minus(4), q_dot(4);
  retract(rotation, q0.data(), Vec(s * omega).data(), plus.data());
  retract(rotation, q0.data(), Vec(-s * omega).data(), minus.data());
  rate(rotation, q0.data(), omega.data(), q_dot.data());
  EXPECT_LT((q_dot - (plus - minus) / (2 * s)).norm(), 1e-9);
}

TEST(Rotation, NormaliseGivesUnitLength) {
  Vec q = 1.1 * q0;
  normalise(rotation, q.data());
  EXPECT_NEAR(q.norm(), 1, 1e-15);
}

TEST(Coordinates, CountPartsInOrder) {
  const Coordinates c = Coordinates::flat(3).then_rotation().then_flat(2);
  EXPECT_EQ(c.nq(), 9);
  EXPECT_EQ(c.nv(), 8);
}

}  // namespace
}  // namespace trammel::model
