#include "simulate/event/root_bracket.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace trammel::numerics {
namespace {

TEST(RootBracket, NarrowsToTheResolutionAskedFor) {
  const auto f = [](double x) { return std::cos(x) - x; };
  const Interval found = narrow(f, {0, 1, f(0), f(1)}, 1e-15);
  EXPECT_LE(found.high - found.low, 1e-15);
  EXPECT_NEAR(found.high, 0.73908513321516064, 1e-15);  // the resolution
}

TEST(RootBracket, KeepsTheSignsOfItsEnds) {
  const auto f = [](double x) { return 1 - x * x * x; };
  const Interval found = narrow(f, {0, 7, f(0), f(7)}, 1e-12);
  EXPECT_GE(f(found.low), 0);
  EXPECT_LE(f(found.high), 0);
}

TEST(RootBracket, TakesAboutTenEvaluationsForASmoothFunction) {
  int evaluations = 0;
  const auto f = [&](double x) { return ++evaluations, 1e-2 - 3 * x - 4.9 * x * x; };
  narrow(f, {0, 1e-2, 1e-2, 1e-2 - 3e-2 - 4.9e-4}, 1e-16);
  EXPECT_LE(evaluations, 12);  // bisection would take 47
}

TEST(RootBracket, ReturnsAnEndThatIsTheRootAlone) {
  const auto f = [](double x) { return 1 - x; };
  for (const Interval& found : {narrow(f, {0, 1, 1, 0}, 1e-12), narrow(f, {1, 7, 0, -6}, 1e-12)}) {
    EXPECT_EQ(found.low, 1);
    EXPECT_EQ(found.high, 1);
  }
}

// Functions that fall from f > 0 at 0 to f < 0 at 1, and how many evaluations their zero takes at most; bisection takes
// 47.
struct Falling {
  std::function<ValueAndSlope(double)> f;
  double zero;
  int most;
};

std::vector<Falling> falling_functions() {
  return {{[](double x) {
             return ValueAndSlope{0.3 - x * x, -2 * x};
           },
           std::sqrt(0.3), 1},
          {[](double x) {
             return ValueAndSlope{0.5 - x * x * x, -3 * x * x};
           },
           std::cbrt(0.5), 1},
          {[](double x) {
             return ValueAndSlope{std::cos(3 * x), -3 * std::sin(3 * x)};
           },
           std::numbers::pi / 6, 3},
          {[](double x) {
             return ValueAndSlope{std::exp(-20 * x) - 1e-4, -20 * std::exp(-20 * x)};
           },
           std::log(1e4) / 20, 8},
          {[](double x) {
             return ValueAndSlope{std::cbrt(0.7 - x), -1 / (3 * std::pow(std::cbrt(0.7 - x), 2))};
           },
           0.7, 50},
          {[](double x) {
             return ValueAndSlope{0.3 - x, 3};
           },
           0.3, 50}};  // a slope that is wrong costs evaluations alone
}

TEST(Crossing, IsFoundToTheResolutionAndLiesBehindTheZero) {
  for (const double begin : {0.0, 100.0}) {
    const double resolution = begin > 0 ? 1e-13 : 1e-14;  // 100: units of 1.4e-14
    for (const auto& [f, zero, most] : falling_functions()) {
      int evaluations = 0;
      const auto counted = [&](double x) {
        EXPECT_TRUE(x > begin && x < begin + 1) << zero;
        return ++evaluations, f(x - begin);
      };
      const double found = crossing(counted, {begin, begin + 1, f(0), f(1)}, resolution, 0) - begin;
      EXPECT_NEAR(found, zero, 2 * resolution);  // and round-off of f
      EXPECT_LE(f(found).f, 0) << zero;
      EXPECT_LE(evaluations, most) << zero;
    }
  }
}

TEST(Crossing, TakesAFewEvaluationsForASmoothFunction) {
  int evaluations = 0;
  const auto f = [&](double x) { return ++evaluations, ValueAndSlope{1e-2 - 3 * x - 4.9 * x * x, -3 - 9.8 * x}; };
  const double found = crossing(f, {0, 1e-2, f(0), f(1e-2)}, 1e-17, 1e-17);
  EXPECT_NEAR(found, (std::sqrt(9 + 4 * 4.9e-2) - 3) / 9.8, 1e-16);
  EXPECT_LE(evaluations, 2 + 3);  // both ends; a parabola is a cubic, so the first is the zero up to round-off
}

TEST(Crossing, IsContentWithRoundOffOfTheFunction) {
  for (const double steepness : {0.01, 1.0, 100.0}) {
    int evaluations = 0;
    const auto f = [&](double x) {  // known to 1e-10 only
      ++evaluations;
      return ValueAndSlope{steepness * (0.25 - x * x) + 5e-11 * std::sin(1e12 * x), -2 * steepness * x};
    };
    EXPECT_NEAR(crossing(f, {0, 1, f(0), f(1)}, 1e-16, 1e-10), 0.5, 3e-10 / steepness);
    EXPECT_LE(evaluations, 2 + 2) << steepness;
  }
}

// The slope at the low end, 3e-12, would place a trial 16 lengths of the bracket beyond it.
TEST(Crossing, StaysInItsBracketWhereASlopeSaysLittle) {
  for (const double begin : {0.0, 10.0}) {
    const auto f = [begin](double x) {
      const double y = x - begin;
      EXPECT_TRUE(y > 0 && y < 1);
      return ValueAndSlope{0.5 - y * y * y, -3 * y * y};
    };
    const ValueAndSlope low{0.5, -3e-12}, high{-0.5, -3};
    EXPECT_NEAR(crossing(f, {begin, begin + 1, low, high}, 1e-14, 1e-10) - begin, std::cbrt(0.5), 1e-10);
  }
}

}  // namespace
}  // namespace trammel::numerics
