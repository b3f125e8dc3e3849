#include "simulate/event/event_search.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "steps_by_formula.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using simulate::find_dip;
using simulate::find_return;
using Kind = EventFunction::Kind;

// c + cos x over a step of length h that begins at `phase`: negative inside by 1 - c at most.
StepsByFormula swing(double c, double phase) {
  return StepsByFormula([=](double x) {
    return simulate::ValueAndSlope{c + std::cos(phase + x), -std::sin(phase + x)};
  });
}

TEST(Dip, IsFoundBetweenPositiveEndsInEveryPhaseOfASwing) {
  const double h = 0.45 * 2 * std::numbers::pi, c = 0.99;
  const double half = std::acos(c);  // negative in pi +- half
  for (double phase = std::numbers::pi + half - h + 0.01; phase < std::numbers::pi - half - 0.01; phase += 0.05) {
    StepsByFormula steps = swing(c, phase);
    EventFunction slip = steps.function(Kind::slide, h);
    ASSERT_GT(std::min(slip.now.f, slip.next.f), 0);
    const auto dip = find_dip(slip, steps.between(slip, h), false, 1e-3 * h, steps);
    ASSERT_TRUE(dip) << phase;
    EXPECT_LT(dip->at_high.f, 0);
    EXPECT_NEAR(phase + dip->high, std::numbers::pi, half);
  }
}

TEST(Dip, IsNoEventIfItStaysAboveZero) {
  StepsByFormula steps = swing(1.05, 2);
  EventFunction slip = steps.function(Kind::slide, 2.3);
  EXPECT_FALSE(find_dip(slip, steps.between(slip, 2.3), false, 1e-3, steps));
}

// The cubic of the ends is lowest at 0.36, the function at 0.2: it is -2e-3 there, and positive outside 0.176 to 0.218.
TEST(Dip, IsFoundByFurtherProbesWhereTheFirstOneMissesIt) {
  StepsByFormula steps([](double x) {
    return simulate::ValueAndSlope{std::exp(-20 * x) + 0.4 * x - 0.1, -20 * std::exp(-20 * x) + 0.4};
  });
  EventFunction gap = steps.function(Kind::approach, 1);
  const auto dip = find_dip(gap, steps.between(gap, 1), false, 1e-3, steps);
  ASSERT_TRUE(dip);
  EXPECT_LT(dip->at_high.f, 0);
  EXPECT_GT(steps.count, 1);
}

TEST(Dip, NeedsNoStepWhereTheCubicIsFarAboveZero) {
  StepsByFormula steps = swing(3, 2);
  EventFunction slip = steps.function(Kind::slide, 2.3);
  EXPECT_FALSE(find_dip(slip, steps.between(slip, 2.3), false, 1e-3, steps));
  EXPECT_EQ(steps.count, 0);
}

// The cubic through the ends of a distance of bodies that pass each other rounds its kink off.
TEST(Dip, IsFoundAtAKinkIfTheFunctionMayHaveOne) {
  StepsByFormula steps([](double x) { return simulate::ValueAndSlope{std::abs(x - 1) - 0.1, x < 1 ? -1. : 1.}; });
  EventFunction gap = steps.function(Kind::approach, 2);
  EXPECT_FALSE(find_dip(gap, steps.between(gap, 2), false, 1e-3, steps));
  const auto dip = find_dip(gap, steps.between(gap, 2), true, 1e-3, steps);
  ASSERT_TRUE(dip);
  EXPECT_NEAR(dip->high, 1, 1e-14);
}

// A gap left at 0 with 1 m/s falls back at 20 m/s^2 after 0.1 s, and bounces from something else before the end.
TEST(Return, IsSeenThoughTheGapIsOpenAtTheEnd) {
  StepsByFormula steps([](double x) {
    const double f = x - 10 * x * x;
    return simulate::ValueAndSlope{x < 0.5 ? f : 1, 1 - 20 * x};
  });
  steps.acceleration = -20;
  EventFunction gap = steps.function(Kind::approach, 1, 1e-12);
  const auto found = find_return(gap, 1, steps);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->high, 0.125, 1e-15);  // 1.25 of the time of return
  EXPECT_LT(found->at_high.f, 0);
}

TEST(Return, IsNotSoughtPastTheEndOfTheStepNorWithoutAcceleration) {
  StepsByFormula steps([](double x) { return simulate::ValueAndSlope{x - 10 * x * x, 1 - 20 * x}; });
  EventFunction gap = steps.function(Kind::approach, 0.05, 1e-12);
  steps.acceleration = -20;
  EXPECT_FALSE(find_return(gap, 0.05, steps));
  steps.acceleration = 20;
  EXPECT_FALSE(find_return(gap, 1, steps));
  EXPECT_EQ(steps.count, 0);
}

}  // namespace
}  // namespace trammel::test
