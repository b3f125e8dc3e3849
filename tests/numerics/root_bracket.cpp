#include "numerics/root_bracket.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trammel::numerics {
namespace {

TEST(RootBracket, NarrowsToTheResolutionAskedFor) {
  const auto f = [](double x) { return std::cos(x) - x; };
  const RootBracket found = narrow(f, {0, 1, f(0), f(1)}, 1e-15);
  EXPECT_LE(found.high - found.low, 1e-15);
  EXPECT_NEAR(found.high, 0.73908513321516064, 1e-15);  // the resolution
}

TEST(RootBracket, KeepsTheSignsOfItsEnds) {
  const auto f = [](double x) { return 1 - x * x * x; };
  const RootBracket found = narrow(f, {0, 7, f(0), f(7)}, 1e-12);
  EXPECT_GE(f(found.low), 0);
  EXPECT_LE(f(found.high), 0);
}

TEST(RootBracket, TakesAboutTenEvaluationsForASmoothFunction) {
  int evaluations = 0;
  const auto f = [&](double x) { return ++evaluations, 1e-2 - 3 * x - 4.9 * x * x; };
  narrow(f, {0, 1e-2, 1e-2, 1e-2 - 3e-2 - 4.9e-4}, 1e-16);
  EXPECT_LE(evaluations, 12);  // bisection would take 47
}

TEST(RootBracket, ReturnsAnEndThatIsTheRoot) {
  const auto f = [](double x) { return 1 - x; };
  EXPECT_EQ(narrow(f, {0, 1, 1, 0}, 1e-12).high, 1);
}

}  // namespace
}  // namespace trammel::numerics
