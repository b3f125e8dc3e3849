// The lengths of steps, for a method whose error is known: e = (h/h_1)^p.
#include "simulate/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <trammel/testing/archive.hpp>

namespace trammel::simulate {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double h_1 = 1e-3;    // [s] error 1
constexpr int p = 4;            // order of the error
constexpr double every = 0.01;  // [s]

double error_of(double h) {
  return std::pow(h / h_1, p);
}

StepChoice controlled(double initial) {
  StepChoice choice;
  choice.initial = initial;
  return choice;
}

StepChoice fixed(double h) {
  StepChoice choice;
  choice.fixed = h;
  return choice;
}

// Accepts the steps whose error is at most 1, from 0 to `stop`; returns their lengths.
std::vector<double> steps_to(StepControl& steps, double stop, double from = 0) {
  std::vector<double> taken;
  for (double t = from; t < stop && taken.size() < 100000;) {
    const StepControl::Proposal proposal = steps.propose(t, stop, infinity);
    if (const double error = error_of(proposal.h); steps.controlled() && error > 1) {
      steps.rejected_for_error(proposal.h, error);
      continue;
    } else {
      steps.accepted(proposal, error);
    }
    taken.push_back(proposal.h);
    t = proposal.t_next;
  }
  return taken;
}

TEST(FixedSteps, AreEqualAndEndAtTheStop) {
  StepControl steps(fixed(0.03), every, 1);
  const std::vector<double> taken = steps_to(steps, 0.1);
  ASSERT_EQ(taken.size(), 4u);  // 0.1/0.03 rounded up
  for (const double h : taken) EXPECT_EQ(h, 0.1 / 4);
}

// From t = 1e4 on, whose round-off is many times that of a step.
TEST(FixedSteps, AreTheStepItselfWhereTheyFitTheStopUpToRoundOffOfTime) {
  StepControl steps(fixed(0.1), every, 1);
  const std::vector<double> taken = steps_to(steps, 1e4 + 10, 1e4);
  ASSERT_EQ(taken.size(), 100u);
  for (const double h : taken) EXPECT_EQ(h, 0.1);
}

// The way to the stop is a multiple of the step but for the rounding of times, of whichever end is farther from 0.
TEST(FixedSteps, AreTheStepItselfWhereTimesAreRounded) {
  struct Way {
    double h, from, stop;
    int parts;
  };
  for (const auto& [h, from, stop, parts] : {Way{0.01, 0.08, 0.58, 50}, Way{0.01, 0.13, 1.13, 100},
                                             Way{0.1, 5.2, 10.2, 50}, Way{0.001, -0.001, 0.009, 10}}) {
    ASSERT_NE((stop - from) / parts, h) << from;
    StepControl steps(fixed(h), every, 1);
    const std::vector<double> taken = steps_to(steps, stop, from);
    ASSERT_EQ(taken.size(), std::size_t(parts));
    for (const double step : taken) EXPECT_EQ(step, h) << from;
  }
}

TEST(FixedSteps, AreOfEqualLengthWhereTheStopIsNoMultiple) {
  StepControl steps(fixed(0.1), every, 1);
  const std::vector<double> taken = steps_to(steps, 10 - 1e-12);  // a hundred times the round-off of 10
  ASSERT_EQ(taken.size(), 100u);
  for (const double h : taken) EXPECT_EQ(h, (10 - 1e-12) / 100);
}

TEST(FixedSteps, ThatAMethodRefusesAreHalvedTenTimesAndThenGivenUp) {
  StepControl steps(fixed(0.1), every, 1);
  for (int halvings = 0; halvings <= 10; ++halvings) {
    const StepControl::Proposal proposal = steps.propose(0, 1, infinity);
    EXPECT_EQ(proposal.h, std::ldexp(0.1, -halvings));
    EXPECT_EQ(proposal.t_next, proposal.h);
    EXPECT_FALSE(steps.too_small(0)) << halvings;
    steps.rejected(proposal.h);
  }
  EXPECT_TRUE(steps.too_small(0));
}

TEST(FixedSteps, AreHalvedFromWhereTheTimeIs) {
  StepControl steps(fixed(0.125), every, 1);
  steps.accepted(steps.propose(2, 3, infinity), 0);
  steps.rejected(steps.propose(2.125, 3, infinity).h);
  const StepControl::Proposal half = steps.propose(2.125, 3, infinity);
  EXPECT_EQ(half.h, 0.0625);
  EXPECT_EQ(half.t_next, 2.1875);
}

TEST(FixedSteps, ThatNoLongerMoveTheTimeAreGivenUp) {
  StepControl steps(fixed(1e-3), every, 1);
  const double t = 1e14;  // 0.016 are one unit in the last place
  steps.propose(t, t + 1, infinity);
  EXPECT_TRUE(steps.too_small(t));
}

TEST(FixedSteps, ThatHalvesMakeTooShortToMoveTheTimeAreGivenUp) {
  StepControl steps(fixed(0.01), every, 1);
  const double t = 1e13;  // 0.002 are one unit in the last place
  for (int halvings = 0; halvings < 4; ++halvings) {
    const StepControl::Proposal proposal = steps.propose(t, t + 1, infinity);
    EXPECT_FALSE(steps.too_small(t)) << halvings;
    steps.rejected(proposal.h);
  }
  EXPECT_TRUE(steps.too_small(t));  // 0.0006
}

TEST(FixedSteps, EndAtTheStopItself) {
  const double h = 1.0 / 49;
  ASSERT_NE(49 * h, 1);
  StepControl steps(fixed(h), every, 1);
  double t = 0;
  for (int i = 0; i < 49; ++i) {
    const StepControl::Proposal proposal = steps.propose(t, 1, infinity);
    steps.accepted(proposal, 0);
    t = proposal.t_next;
  }
  EXPECT_EQ(t, 1);
}

TEST(FixedSteps, AreAsLongAsBeforeOnceAHalvedOneIsTaken) {
  StepControl steps(fixed(0.125), every, 1);
  const StepControl::Proposal whole = steps.propose(0, 1, infinity);
  steps.rejected(whole.h);
  const StepControl::Proposal half = steps.propose(0, 1, infinity);
  steps.accepted(half, 0);
  // 7.5 steps are left: 8 of equal length.
  EXPECT_EQ(steps.propose(half.t_next, 1, infinity).h, (1 - half.h) / 8);
}

TEST(FixedSteps, AreNotLimitedByWhatLimitsControlledOnes) {
  StepControl steps(fixed(0.125), every, 1);
  EXPECT_EQ(steps.propose(0, 1, 0.01).h, 0.125);
}

// Where the factor is 1: 0.9 e^(-0.3/p) = 1. The deviation x of log e from there follows
// x_(n+1) = (1 - 0.7) x_n + 0.4 x_(n-1), whose roots are 0.8 and -0.5.
TEST(ControlledSteps, ApproachTheLengthOfTheirToleranceByAFifthEachStep) {
  const double at_rest = std::pow(0.9, p / 0.3);
  StepControl steps(controlled(0.7 * h_1 * std::pow(at_rest, 1.0 / p)), 1, p);
  const std::vector<double> taken = steps_to(steps, 100 * h_1);
  ASSERT_GT(taken.size(), 50u);
  const auto off = [&](std::size_t i) { return std::log(error_of(taken[i]) / at_rest); };
  EXPECT_NEAR(off(40), 0, 1e-3);                                                      // 0.8^40 of log 0.7^-4
  for (std::size_t i = 25; i < 35; ++i) EXPECT_NEAR(off(i + 1) / off(i), 0.8, 1e-4);  // (0.5/0.8)^25 is left
}

TEST(ControlledSteps, GrowByFiveAtMostAndShrinkByFiveAtMost) {
  StepControl steps(controlled(1e-5), 1, 1);
  const StepControl::Proposal first = steps.propose(0, 1, infinity);
  EXPECT_EQ(first.h, 1e-5);
  steps.accepted(first, 0);
  const StepControl::Proposal second = steps.propose(0, 1, infinity);
  EXPECT_EQ(second.h, 5e-5);
  steps.accepted(second, 1);  // after next to no error: 0.9 (1e-4)^0.4 = 0.02
  EXPECT_EQ(steps.propose(0, 1, infinity).h, 1e-5);
}

// An error of none would let the next step's error count for nothing.
TEST(ControlledSteps, TakeNoErrorForLessThanATenThousandth) {
  StepControl steps(controlled(1e-5), 1, p);
  steps.accepted(steps.propose(0, 1, infinity), 0);
  const StepControl::Proposal second = steps.propose(0, 1, infinity);
  steps.accepted(second, 1);
  EXPECT_DOUBLE_EQ(steps.propose(0, 1, infinity).h, second.h * 0.9 * std::pow(1e-4, 0.4 / p));
}

// e was (h/h_1)^p: with 0.9 e^(-1/p) the next one has 0.9^p.
TEST(ControlledSteps, AreRepeatedWithNineTenthsOfWhatTheErrorAllows) {
  StepControl steps(controlled(2e-3), 1, p);
  steps.rejected_for_error(2e-3, error_of(2e-3));
  EXPECT_DOUBLE_EQ(steps.propose(0, 1, infinity).h, 0.9 * h_1);
}

TEST(ControlledSteps, AreRepeatedWithATenthAtLeastAlsoWhereTheErrorIsNoNumber) {
  StepControl steps(controlled(1), 1, p);
  const auto after = [&](double error) {
    steps.rejected_for_error(1, error);
    return steps.propose(0, 10, infinity).h;
  };
  EXPECT_EQ(after(1e9), 0.1);
  EXPECT_EQ(after(infinity), 0.1);
  EXPECT_EQ(after(std::numeric_limits<double>::quiet_NaN()), 0.1);
}

TEST(ControlledSteps, ThatAMethodRefusesAreRepeatedWithAQuarter) {
  StepControl steps(controlled(1), 1, p);
  steps.rejected(1);
  EXPECT_EQ(steps.propose(0, 10, infinity).h, 0.25);
}

// No step as short as what is left over.
TEST(ControlledSteps, ThatNearlyReachTheStopAreTwoEqualOnes) {
  StepControl steps(controlled(1), 1, p);
  const StepControl::Proposal first = steps.propose(0, 1.01, infinity);
  EXPECT_EQ(first.h, 1.01 / 2);
  EXPECT_EQ(first.t_next, 1.01 / 2);
  const StepControl::Proposal far = steps.propose(0, 2.01, infinity);
  EXPECT_EQ(far.h, 1);
  const StepControl::Proposal last = steps.propose(0, 1 + 1e-12, infinity);  // a rest that is round-off
  EXPECT_EQ(last.h, 1 + 1e-12);
  EXPECT_EQ(last.t_next, 1 + 1e-12);
}

TEST(ControlledSteps, AreNotShorterAfterOneThatOnlyReachedItsStop) {
  StepControl steps(controlled(1), 1, p);
  const StepControl::Proposal short_one = steps.propose(0, 0.01, infinity);
  EXPECT_EQ(short_one.h, 0.01);
  steps.accepted(short_one, 1e-3);
  EXPECT_EQ(steps.propose(0.01, 10, infinity).h, 1);
}

TEST(ControlledSteps, KeepToTheirLimits) {
  StepChoice choice = controlled(1);
  choice.most = 0.5;
  StepControl steps(choice, 1, p);
  EXPECT_EQ(steps.propose(0, 10, infinity).h, 0.5);
  EXPECT_EQ(steps.propose(0, 10, 0.1).h, 0.1);
  StepControl without(controlled(100), 1, p);
  EXPECT_EQ(without.propose(0, 1000, infinity).h, 20);  // times between records
}

TEST(ControlledSteps, BeginWithTheTimeBetweenRecordsUnlessTheSceneSays) {
  StepControl steps(controlled(0), every, p);
  EXPECT_EQ(steps.propose(0, 10, infinity).h, every);
  StepChoice coarse = controlled(0);
  coarse.least = 2 * every;
  StepControl least(coarse, every, p);
  EXPECT_EQ(least.propose(0, 10, infinity).h, 2 * every);
}

TEST(ControlledSteps, AreTooSmallBelowTheScenesLeastOrSixteenUnitsOfTime) {
  constexpr double unit = std::numeric_limits<double>::epsilon();
  StepChoice choice = controlled(1e-3);
  choice.least = 1e-4;
  StepControl steps(choice, every, p);
  EXPECT_EQ(steps.smallest(1), 1e-4);
  EXPECT_FALSE(steps.too_small(1));
  steps.rejected(1e-3);
  EXPECT_FALSE(steps.too_small(1));  // 2.5e-4
  steps.rejected(2.5e-4);
  EXPECT_TRUE(steps.too_small(1));
  StepControl without(controlled(1e-3), every, p);
  EXPECT_EQ(without.smallest(-8), 16 * unit * 8);
  EXPECT_EQ(without.smallest(0), 16 * unit * every);
}

// Methods whose steps are longer than the oscillations in them.
TEST(EvenSteps, ChangeOnlyToBeAQuarterLonger) {
  StepControl steps(controlled(1), 10, 1, true);
  const auto after = [&](double error) {  // twice, so that it is the larger of the last two
    for (int i = 0; i < 2; ++i) steps.accepted(steps.propose(0, 1000, infinity), error);
    return steps.propose(0, 1000, infinity).h;
  };
  EXPECT_EQ(after(0.9 / 1.24), 1);
  EXPECT_EQ(after(1), 1);  // nor shorter
  EXPECT_DOUBLE_EQ(after(0.9 / 1.26), 1.26);
}

TEST(EvenSteps, GoByTheLargerOfTheLastTwoErrors) {
  StepControl steps(controlled(1), 10, 1, true);
  steps.accepted(steps.propose(0, 1000, infinity), 1);
  steps.accepted(steps.propose(0, 1000, infinity), 0.1);
  EXPECT_EQ(steps.propose(0, 1000, infinity).h, 1);
  steps.accepted(steps.propose(0, 1000, infinity), 0.3);
  EXPECT_DOUBLE_EQ(steps.propose(0, 1000, infinity).h, 3);
}

TEST(EvenSteps, GoByTheRootOfTheErrorThatIsTheOrder) {
  StepControl steps(controlled(1), 10, 2, true);
  steps.accepted(steps.propose(0, 1000, infinity), 0.25);
  steps.accepted(steps.propose(0, 1000, infinity), 0.25);
  EXPECT_DOUBLE_EQ(steps.propose(0, 1000, infinity).h, 0.9 / 0.5);
}

TEST(EvenSteps, GrowByFiveAtMost) {
  StepControl steps(controlled(1), 10, 1, true);
  for (int i = 0; i < 2; ++i) steps.accepted(steps.propose(0, 1000, infinity), 0);
  EXPECT_EQ(steps.propose(0, 1000, infinity).h, 5);
}

TEST(EvenSteps, AreOfEqualLengthBeforeAStop) {
  StepControl steps(controlled(0.5), 10, 1, true);
  double t = 0;
  std::vector<double> taken;
  while (t < 4.75) {
    const StepControl::Proposal proposal = steps.propose(t, 4.75, infinity);
    steps.accepted(proposal, 1);
    taken.push_back(proposal.h);
    t = proposal.t_next;
  }
  // Of 9.5 lengths two whole ones, then what is left, less than eight, in eight equal steps.
  ASSERT_EQ(taken.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(taken[i], i < 2 ? 0.5 : 3.75 / 8) << i;
}

// What is left is planned anew, in equal steps of what the refused one allows.
TEST(EvenSteps, AreShorterAtOnceWhereTheLastOnesAreRefused) {
  for (const bool by_error : {true, false}) {
    StepControl steps(controlled(0.5), 10, 1, true);
    const double stop = 0.5, h = steps.propose(0, stop, infinity).h;
    EXPECT_EQ(h, stop);
    by_error ? steps.rejected_for_error(h, 1.2) : steps.rejected(h);
    EXPECT_EQ(steps.propose(0, stop, infinity).h, by_error ? stop / 2 : stop / 4);
  }
}

TEST(StepControl, GoesOnFromAnArchiveAsIfItHadNotStopped) {
  for (const bool even : {false, true})
    for (const StepChoice& choice : {controlled(0.7 * h_1), fixed(h_1)}) {
      StepControl whole(choice, every, p, even), resumed(choice, every, p, even);
      const double half = steps_to(whole, 0.05).back();
      ASSERT_GT(half, 0);
      whole.propose(0.05, 0.1, infinity);
      whole.rejected(half);
      MemoryArchive archive;
      whole.archive(archive, "step_");
      archive.reading = true;
      resumed.archive(archive, "step_");
      EXPECT_EQ(steps_to(whole, 0.1, 0.05), steps_to(resumed, 0.1, 0.05));
    }
}

}  // namespace
}  // namespace trammel::simulate
