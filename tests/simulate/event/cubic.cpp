#include "simulate/event/cubic.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trammel::numerics {
namespace {

// x^3 - 3 x on [low, high]: its minimum is -2 at x = 1, its maximum 2 at -1.
Cubic between(double low, double high, double raised = 0) {
  const auto f = [&](double x) { return ValueAndSlope{x * x * x - 3 * x + raised, 3 * x * x - 3}; };
  return {low, high, f(low), f(high)};
}

TEST(Cubic, IsThatOfTheValuesAndSlopesAtItsEnds) {
  for (const double part : {0.0, 0.25, 0.5, 1.0}) {
    const double x = -2 + part * 5;
    EXPECT_NEAR(between(-2, 3).value(part), x * x * x - 3 * x, 1e-13);  // round-off of numbers up to 27
  }
}

TEST(Cubic, HasItsMinimumInsideTheInterval) {
  const auto minimum = between(0, 3, 2.5).minimum();
  ASSERT_TRUE(minimum);
  EXPECT_NEAR(minimum->at, 1, 1e-14);
  EXPECT_NEAR(minimum->f, 0.5, 1e-14);
}

TEST(Cubic, HasNoMinimumWhereItRisesOrFallsOrHasAMaximumOnly) {
  EXPECT_FALSE(between(1.1, 3).minimum());
  EXPECT_FALSE(between(-0.5, 0.9).minimum());
  EXPECT_FALSE(between(-3, 0).minimum());
}

// Both ends fall towards the inside, so there is a minimum, which may be as near to an end as round-off.
TEST(Cubic, PlacesAMinimumAtAnEndALittleInside) {
  const auto minimum = between(1 - 1e-9, 3).minimum();
  ASSERT_TRUE(minimum);
  EXPECT_GT(minimum->at, 1.0001);
  EXPECT_LT(minimum->at, 1.01);
}

// The cubic through both ends of abs(x - 1) - 0.1 on [0, 2] is 0.4 at its lowest.
TEST(Cubic, TellsWhereItsTangentsMeetBelowZero) {
  const Cubic kinked{0, 2, {0.9, -1}, {0.9, 1}};
  EXPECT_GT(kinked.minimum()->f, 0);
  ASSERT_TRUE(kinked.kink_below_zero());
  EXPECT_NEAR(*kinked.kink_below_zero(), 1, 1e-15);
  EXPECT_FALSE((Cubic{0, 2, {1.1, -1}, {1.1, 1}}.kink_below_zero()));   // above 0
  EXPECT_FALSE((Cubic{0, 2, {0.9, -1}, {0.1, -1}}.kink_below_zero()));  // one end rises inwards
}

// -size (x - zero) (1 + bend (x - middle)^2) has no other zero.
TEST(Cubic, FindsItsCrossing) {
  for (const double zero : {2.001, 2.3, 3.5, 4.9})
    for (const double middle : {1.0, 2.5, 3.5, 6.0})
      for (const double bend : {0.0, 0.1, 1.0, 1e3})
        for (const double size : {1e-4, 1.0, 1e4}) {
          const auto f = [&](double x) {
            const double from = x - middle;
            return ValueAndSlope{-size * (x - zero) * (1 + bend * from * from),
                                 -size * (1 + bend * from * from + 2 * bend * (x - zero) * from)};
          };
          EXPECT_NEAR((Cubic{2, 5, f(2), f(5)}.crossing()), zero, 1e-14 * (1 + bend))
              << middle << " " << bend << " " << size;
        }
}

}  // namespace
}  // namespace trammel::numerics
