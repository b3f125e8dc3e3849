#include <trammel/joint_rows.hpp>

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

}  // namespace
}  // namespace trammel
