#include <trammel/joint_rows.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <trammel/component.hpp>

namespace trammel {
namespace {

// Numbers whose squares are beyond the range of numbers.
TEST(UnitAxis, IsThatOfADirectionOfAnyLength) {
  for (const double length : {1e-200, 1.0, 1e200}) {
    const Vec3 axis = unit_axis(Eigen::Vector3d(3 * length, 0, -4 * length), "axis");
    EXPECT_NEAR((axis - Eigen::Vector3d(0.6, 0, -0.8)).norm(), 0, 1e-15) << length;
  }
}

TEST(UnitAxis, OfNoLengthIsRefused) {
  try {
    unit_axis(Eigen::Vector3d::Zero(), "axis");
    FAIL() << "accepted";
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.parameter(), "axis");
  }
}

TEST(UnitQuaternion, IsThatOfFourNumbersOfAnySize) {
  World world;
  world.space = Space::spatial;
  for (const double size : {1e-200, 1.0, 1e200}) {
    const Eigen::Quaterniond p = unit_quaternion(world, {3 * size, 0, 4 * size, 0}, "orientation");
    EXPECT_NEAR((p.coeffs() - Eigen::Vector4d(0, 0.8, 0, 0.6)).norm(), 0, 1e-15) << size;  // (x, y, z, w)
  }
}

TEST(SmallestRotation, TurnsADirectionToAnyOther) {
  const Eigen::Vector3d from(1, 2, -2), normal = from.unitOrthogonal();
  for (const double left : {0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 0.1, 1.0, 2.0, M_PI}) {  // of half a turn
    const Eigen::Vector3d to = 5 * (Eigen::AngleAxisd(M_PI - left, normal) * from);
    const Eigen::Quaterniond turn = smallest_rotation(from, to);
    EXPECT_NEAR(turn.norm(), 1, 1e-15) << left;
    // Its axis is a x b, whose errors are those of round-off over the angle that is left.
    EXPECT_NEAR((turn * from.normalized() - to.normalized()).norm(), 0,
                left > 5e-7 ? 1e-15 / std::min(left, 1.0) : 1e-15)
        << left;
    EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), M_PI - left, 2e-6) << left;
  }
}

}  // namespace
}  // namespace trammel
