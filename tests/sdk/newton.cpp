#include <gtest/gtest.h>

#include <cmath>

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

// What is left of an unknown when an iteration whose increments shrink by `theta` has converged; its limit is 1.
double error_left(double theta, double tolerance) {
  Newton newton;
  newton.tolerance = tolerance;
  newton.max_iterations = 2000;
  newton.start();
  double error = 1;
  while (newton.iterating()) {
    const double change = (1 - theta) * error;
    error *= theta;
    newton.judge(change, false);
  }
  EXPECT_TRUE(newton.converged());
  return error;
}

// theta/(1 - theta) times the last increment is the error left, exactly where increments shrink by the same factor each
// time.
TEST(Newton, EndsWithAnErrorBelowItsToleranceAndNoIterationLater) {
  for (const double theta : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    const double error = error_left(theta, 1e-6);
    EXPECT_LE(error, 1e-6 * (1 + 1e-9)) << theta;          // round-off of the sums of increments
    EXPECT_GE(error, 1e-6 * theta * (1 - 1e-9)) << theta;  // one increment earlier it was above
  }
}

TEST(Newton, TakesItsFirstIncrementForItsError) {
  Newton newton;
  newton.tolerance = 1e-6;
  newton.start();
  newton.judge(2e-6, false);
  EXPECT_TRUE(newton.iterating());
  newton.start();
  newton.judge(0.5e-6, false);
  EXPECT_TRUE(newton.converged());
}

TEST(Newton, EndsAtRoundOffFromTheSecondIncrementOn) {
  Newton newton;
  newton.start();
  newton.judge(1e-3, true);
  EXPECT_TRUE(newton.iterating()) << "the first one has nothing to be compared with";
  newton.judge(0.9e-3, true);
  EXPECT_TRUE(newton.converged());
}

TEST(Newton, EndsWhereNothingChanges) {
  EXPECT_TRUE(after({0}).converged());
  EXPECT_TRUE(after({1e-3, 0}).converged());
}

TEST(Newton, WantsFactorsAtItsStartAndWhereIncrementsShrinkSlowly) {
  Newton newton;
  newton.start();
  EXPECT_TRUE(newton.wants_factors());
  newton.judge(1, false);
  EXPECT_FALSE(newton.wants_factors()) << "after one increment nothing is known of its rate";
  newton.judge(0.1, false);
  EXPECT_FALSE(newton.wants_factors()) << "rate 0.1";
  newton.judge(0.05, false);
  EXPECT_TRUE(newton.wants_factors()) << "rate 0.5";
  newton.judge(1e-3, false);
  EXPECT_FALSE(newton.wants_factors()) << "the new factors serve";
  newton.start();
  EXPECT_TRUE(newton.wants_factors());
}

TEST(Newton, GivesUpAfterItsLastIterationAndNotBefore) {
  Newton newton;
  newton.max_iterations = 3;
  newton.start();
  newton.judge(1e-1, false), newton.judge(1e-2, false);
  EXPECT_TRUE(newton.iterating());
  newton.judge(1e-3, false);
  EXPECT_FALSE(newton.iterating());
  EXPECT_FALSE(newton.converged());
  EXPECT_STREQ(newton.outcome().reason(), "Newton's iteration did not converge");
}

TEST(Newton, RefusesIncrementsThatAreNoNumbers) {
  for (const double change : {std::nan(""), HUGE_VAL}) {
    const Newton newton = after({1e-3, change});
    EXPECT_FALSE(newton.iterating());
    EXPECT_FALSE(newton.converged());
  }
}

TEST(Newton, BeginsAnewWithEachStep) {
  Newton newton = after({1e-3, 1e-6});
  newton.start();
  EXPECT_TRUE(newton.iterating());
  EXPECT_EQ(newton.rate(), 1);
  newton.judge(1e-9, false);
  EXPECT_TRUE(newton.iterating()) << "an increment of the last step is no measure for this one";
}

// fast() lets the caller skip the test for round-off, which costs a solution, while the iteration may continue.
TEST(Newton, IsFastWhileIncrementsHalveAndIterationsAreLeft) {
  Newton newton;
  newton.max_iterations = 4;
  newton.start();
  EXPECT_TRUE(newton.fast(1));
  newton.judge(1, false);
  EXPECT_TRUE(newton.fast(0.4));
  EXPECT_FALSE(newton.fast(0.6));
  newton.judge(0.4, false);
  EXPECT_TRUE(newton.fast(0.1));
  newton.judge(0.1, false);
  EXPECT_FALSE(newton.fast(0.01)) << "the last iteration";
}

// Large: more than a tenth.
TEST(Newton, GivesUpWhenLargeIncrementsGrowTwiceInARow) {
  for (const Newton& newton : {after({0.01, 0.2, 0.5}), after({0.05, 0.06, 0.11})}) {
    EXPECT_FALSE(newton.iterating());
    EXPECT_FALSE(newton.converged());
  }
  EXPECT_TRUE(after({0.05, 0.06, 0.09}).iterating());
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
  EXPECT_TRUE(after({2e-11, 1.9e-11}, 1e-3).iterating());  // at this rate the remaining error is large
  EXPECT_TRUE(after({0.9e-11}, 1e-3).converged());
}

TEST(Newton, GoesOnWhileIncrementsAreSmall) {
  EXPECT_TRUE(after({1e-6, 1e-5, 1e-4, 1e-3}).iterating());
}

}  // namespace
}  // namespace trammel
