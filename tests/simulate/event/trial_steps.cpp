// What the end of a step shows of an event.
#include "simulate/event/trial_steps.hpp"

#include <gtest/gtest.h>

#include "steps_by_formula.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using Kind = EventFunction::Kind;

StepsByFormula without_motion(double acceleration = 0) {
  StepsByFormula steps([](double) { return simulate::ValueAndSlope{1, 0}; });
  steps.acceleration = acceleration;
  return steps;
}
EventFunction gap_with(double value, double rate) {
  return {.contact = 0, .kind = Kind::approach, .noise = 1e-12, .now = {value, rate}};
}

TEST(Event, HappenedIfAPositiveFunctionIsNegative) {
  EventFunction gap = gap_with(1, -1);
  EXPECT_TRUE(without_motion().happened(gap, {-1e-15, -1}));
  EXPECT_FALSE(without_motion().happened(gap, {0, -1}));
}

TEST(Event, HappenedAgainOnlyBelowWhatCountsAsZero) {
  EventFunction force{.contact = 0, .kind = Kind::press, .noise = 1e-3, .now = {1e-4, 0}};
  EXPECT_FALSE(without_motion().happened(force, {-0.9e-3, 0}));
  EXPECT_TRUE(without_motion().happened(force, {-1.1e-3, 0}));
  force.now.f = -0.5;  // it began below 0
  EXPECT_FALSE(without_motion().happened(force, {-0.5, 0}));
  EXPECT_TRUE(without_motion().happened(force, {-0.502, 0}));
}

TEST(Event, HappenedAgainIfAGapFallsFasterThanImpactsLeaveIt) {
  const EventFunction gap = gap_with(0, -1e-3);
  EXPECT_TRUE(without_motion().happened(gap, {-1e-14, -1e-3}));
  EXPECT_FALSE(without_motion().happened(gap, {-1e-14, -1e-10}));
}

TEST(Event, IsNoneIfTheGapOpensAgainBeforeItIsDeeperThanTouching) {
  const EventFunction gap = gap_with(0, -1e-7);
  EXPECT_FALSE(without_motion(1).happened(gap, {-1e-14, -1e-7}));    // 5e-15 deep
  EXPECT_TRUE(without_motion(1e-3).happened(gap, {-1e-14, -1e-7}));  // 5e-12 deep
  EXPECT_TRUE(without_motion(-1).happened(gap, {-1e-14, -1e-7}));    // it falls on
}

}  // namespace
}  // namespace trammel::test
