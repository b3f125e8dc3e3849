#include "simulate/event/first_event.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "steps_by_formula.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using simulate::locate_first;
using simulate::Located;
using Kind = EventFunction::Kind;

Formula falls(double zero, double steepness = 1) {
  return [=](double x) {
    return simulate::ValueAndSlope{steepness * (zero - x) * (1 + x), steepness * (zero - 1 - 2 * x)};
  };
}

TEST(FirstEvent, IsTheEarliestZeroToTheRoundingOfTime) {
  for (const double t : {0.0, 100.0})
    for (const Kind kind : {Kind::approach, Kind::press, Kind::slide}) {
      StepsByFormula steps({falls(0.7), falls(0.3), falls(0.5)});
      EventFunction all[] = {steps.function(kind, 1, 0, 0), steps.function(kind, 1, 0, 1),
                             steps.function(kind, 1, 0, 2)};
      const Located first =
          locate_first({{&all[0], 1, all[0].next}, {&all[1], 1, all[1].next}, {&all[2], 1, all[2].next}}, t, 1, steps);
      EXPECT_EQ(first.function, &all[1]);
      EXPECT_NEAR(first.h, 0.3, 1e-15 + 4e-16 * t) << t;
    }
}

TEST(FirstEvent, CostsLaterOnesASingleStepEach) {
  StepsByFormula one({falls(0.3)}), two({falls(0.3), falls(0.9)});
  EventFunction alone = one.function(Kind::approach, 1);
  locate_first({{&alone, 1, alone.next}}, 0, 1, one);
  EventFunction first = two.function(Kind::approach, 1), later = two.function(Kind::approach, 1, 0, 1);
  locate_first({{&later, 1, later.next}, {&first, 1, first.next}}, 0, 1, two);
  EXPECT_EQ(two.count, one.count + 1);
}

// The line between the ends of the first force crosses 0 at 0.2, the force itself at 0.6.
TEST(FirstEvent, IsTheEarliestOneThoughAnotherWasExpectedBefore) {
  StepsByFormula steps({[](double x) {
                          return simulate::ValueAndSlope{1 - 5 * std::pow(x, std::log(5) / -std::log(0.6)), 0};
                        },
                        falls(0.4)});
  EventFunction late = steps.function(Kind::press, 1), early = steps.function(Kind::press, 1, 0, 1);
  const Located first = locate_first({{&late, 1, late.next}, {&early, 1, early.next}}, 0, 1, steps);
  EXPECT_EQ(first.function, &early);
  EXPECT_NEAR(first.h, 0.4, 1e-15);
}

TEST(FirstEvent, AdvancesTime) {
  StepsByFormula steps(falls(1e-20));
  EventFunction gap = steps.function(Kind::approach, 1);
  const Located first = locate_first({{&gap, 1, gap.next}}, 5, 1, steps);
  EXPECT_GT(5 + first.h, 5);
  EXPECT_LT(first.h, 1e-14);
}

// A gap left at 0, which opens and closes again.
TEST(FirstEvent, OfAFunctionJustHandledIsItsNextOne) {
  StepsByFormula steps([](double x) { return simulate::ValueAndSlope{x * (0.3 - x), 0.3 - 2 * x}; });
  EventFunction gap = steps.function(Kind::approach, 1, 1e-12);
  const Located first = locate_first({{&gap, 1, gap.next}}, 0, 1, steps);
  EXPECT_NEAR(first.h, 0.3, 1e-14);
}

// It was 0 at an event and only falls from there: what an event has not changed is not repeated at the same instant.
TEST(FirstEvent, OfAFunctionThatFallsOnIsWhereItShows) {
  StepsByFormula steps([](double x) { return simulate::ValueAndSlope{-x, -1}; });
  EventFunction force = steps.function(Kind::press, 1, 0.1);
  const Located first = locate_first({{&force, 1, force.next}}, 0, 1, steps);
  EXPECT_GT(first.h, 0.1);
  EXPECT_LE(first.h, 0.2);  // by halves
}

}  // namespace
}  // namespace trammel::test
