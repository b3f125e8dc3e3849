#include "simulate/root_bracket.hpp"

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

// Of functions that fall from f > 0 at 0 to f < 0 at 1.
struct Falling {
  std::function<ValueAndSlope(double)> f;
  double zero;
};

std::vector<Falling> falling_functions() {
  return {{[](double x) {
             return ValueAndSlope{0.3 - x * x, -2 * x};
           },
           std::sqrt(0.3)},
          {[](double x) {
             return ValueAndSlope{std::cos(3 * x), -3 * std::sin(3 * x)};
           },
           std::numbers::pi / 6},
          {[](double x) {
             return ValueAndSlope{std::exp(-20 * x) - 1e-4, -20 * std::exp(-20 * x)};
           },
           std::log(1e4) / 20},
          {[](double x) {
             return ValueAndSlope{std::cbrt(0.7 - x), -1 / (3 * std::pow(std::cbrt(0.7 - x), 2))};
           },
           0.7},
          {[](double x) {
             return ValueAndSlope{0.5 - x, 3};
           },
           0.5}};  // a slope that is wrong costs evaluations alone
}

TEST(Crossing, IsFoundToTheResolutionAndLiesBehindTheZero) {
  for (const auto& [f, zero] : falling_functions()) {
    int evaluations = 0;
    const auto counted = [&](double x) { return ++evaluations, f(x); };
    const double found = crossing(counted, {0, 1, f(0), f(1)}, 1e-14, 0);
    EXPECT_NEAR(found, zero, 2e-14);  // the resolution and round-off of f
    EXPECT_LE(f(found).f, 0) << zero;
    EXPECT_LE(evaluations, 100) << zero;  // bisection takes 47, at worst every other evaluation is one
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
  int evaluations = 0;
  const auto f = [&](double x) {  // known to 1e-10 only
    ++evaluations;
    return ValueAndSlope{std::round((0.25 - x * x) * 1e10) / 1e10, -2 * x};
  };
  EXPECT_NEAR(crossing(f, {0, 1, f(0), f(1)}, 1e-16, 1e-10), 0.5, 3e-10);
  EXPECT_LE(evaluations, 2 + 8);
}

}  // namespace
}  // namespace trammel::numerics
