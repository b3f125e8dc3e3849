#include <gtest/gtest.h>

#include <trammel/methods/newton.hpp>

namespace trammel {
namespace {

Newton after(std::initializer_list<double> changes, double share_of_first = 0) {
  Newton newton;
  newton.start(share_of_first);
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

// Of 1e-3, 1e-5 the error left is 1e-7: theta/(1 - theta) times the last.
TEST(Newton, EndsAtTheShareOfTheFirstIncrementThatIsEnough) {
  EXPECT_TRUE(after({1e-3, 1e-5}).iterating());
  EXPECT_TRUE(after({1e-3, 1e-5}, 0.9e-4).iterating());
  EXPECT_TRUE(after({1e-3, 1e-5}, 1.1e-4).converged());
}

TEST(Newton, IsNeverLooserThanAskedForByAFirstIncrementWithinTheTolerance) {
  EXPECT_TRUE(after({2e-11, 1.9e-11}, 1e-3).iterating());  // a rate that tells of much more to come
  EXPECT_TRUE(after({0.9e-11}, 1e-3).converged());
}

TEST(Newton, GoesOnWhileIncrementsAreSmall) {
  EXPECT_TRUE(after({1e-6, 1e-5, 1e-4, 1e-3}).iterating());
}

}  // namespace
}  // namespace trammel
