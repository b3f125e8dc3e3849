#include <gtest/gtest.h>

#include <trammel/methods/newton.hpp>

namespace trammel {
namespace {

Newton after(std::initializer_list<double> changes) {
  Newton newton;
  newton.start();
  for (const double change : changes) {
    EXPECT_TRUE(newton.iterating()) << change;
    newton.judge(change, false);
  }
  return newton;
}

TEST(Newton, GivesUpWhenLargeIncrementsGrowTwiceInARow) {
  const Newton newton = after({0.01, 0.2, 0.5});
  EXPECT_FALSE(newton.iterating());
  EXPECT_FALSE(newton.converged());
}

TEST(Newton, GoesOnAfterOneThatGrows) {
  EXPECT_TRUE(after({0.01, 0.5, 0.2, 0.3, 0.1}).iterating());
  EXPECT_TRUE(after({0.01, 0.5, 0.2, 1e-3, 1e-12}).converged());
}

TEST(Newton, GoesOnWhileIncrementsAreSmall) {
  EXPECT_TRUE(after({1e-6, 1e-5, 1e-4, 1e-3}).iterating());
}

}  // namespace
}  // namespace trammel
