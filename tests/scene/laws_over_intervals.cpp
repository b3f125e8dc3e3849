// Ranges of laws of time over intervals of time, and steps whose ends show what a law does within them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/expression.hpp"
#include "scene/laws/law_code.hpp"
#include "scene/laws/resolution.hpp"
#include "scene/laws/tabulated_law.hpp"

namespace trammel::scene {
namespace {

using Jet = TimeFunction::Jet;
using Beyond = TabulatedLaw::Beyond;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double from, double to) { return from + (to - from) * double(engine_()) / 4294967296.0; }
  int below(int n) { return int((*this)(0, n)); }

 private:
  std::mt19937 engine_;
};

std::string random_formula(Random& random, int depth) {
  if (depth == 0)
    return random.below(3) > 0 ? fmt::format("({:.3f}*t)", random(-3, 3)) : fmt::format("{:.3f}", random(-2, 2));
  const auto part = [&] { return random_formula(random, depth - 1); };
  static const std::vector<std::string> functions = {"sin",  "cos",  "tan",  "asin",  "acos", "atan",
                                                     "sinh", "cosh", "tanh", "exp",   "log",  "sqrt",
                                                     "abs",  "sign", "step", "floor", "ceil", "-"};
  static const std::vector<std::string> pairs = {"+", "-", "*", "/", "^"}, of_two = {"atan2", "min", "max"};
  switch (random.below(4)) {
    case 0:
      return fmt::format("({}){}({})", part(), pairs[std::size_t(random.below(5))], part());
    case 1:
      return fmt::format("{}({},{})", of_two[std::size_t(random.below(3))], part(), part());
    case 2:
      return fmt::format("({})^{}", part(), random.below(6) - 2);
    default:
      return fmt::format("{}({})", functions[std::size_t(random.below(int(functions.size())))], part());
  }
}

TimeFunction law_of(const std::string& formula) {
  return compile_time_function(formula, [](std::string_view, int) { return 0.0; });
}

// A law that varies and whose constants are numbers, unlike log(-1).
std::optional<TimeFunction> varying_law(const std::string& formula) {
  try {
    const TimeFunction law = law_of(formula);
    if (!law.is_constant()) return law;
  } catch (const ExpressionError&) {
  }
  return {};
}

// A distance of values that are rounded: a few thousand units of the last digit of the largest intermediate result.
testing::AssertionResult holds(const Range& range, double x, double size, const char* what) {
  const double round_off = 1e-9 * (1 + size + std::abs(x));
  if (!(x < range.lower() - round_off) && !(x > range.upper() + round_off)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << what << " " << x << " is not in [" << range.lower() << ", " << range.upper()
                                     << "]";
}

// The first three jets' entries at instants of the interval, and differences of the second derivative for the third and
// fourth, where the law is so smooth.
void expect_enclosed(const TimeFunction::Code& law, double from, double to, const std::string& name) {
  const Series ranges = law.enclose({from, to}, 6);
  constexpr int parts = 16;
  const double h = (to - from) / parts;
  std::vector<Jet> jets;
  for (int i = 0; i <= parts; ++i) jets.push_back(law.jet(i == parts ? to : from + i * h));
  double size = 0;
  for (const Jet& jet : jets) {
    if (!std::isfinite(jet.value) || !std::isfinite(jet.rate) || !std::isfinite(jet.second)) return;
    size = std::max({size, std::abs(jet.value), std::abs(jet.rate), std::abs(jet.second)});
  }
  if (size > 1e4) return;  // round-off would decide
  for (const Jet& jet : jets) {
    ASSERT_TRUE(holds(ranges.derivative(0), jet.value, size, "value")) << name << " in " << from << " .. " << to;
    ASSERT_TRUE(holds(ranges.derivative(1), jet.rate, size, "rate")) << name << " in " << from << " .. " << to;
    ASSERT_TRUE(holds(ranges.derivative(2), jet.second, size, "second")) << name << " in " << from << " .. " << to;
  }
  for (int i = 1; i < parts; ++i) {
    const double before = jets[std::size_t(i - 1)].second, at = jets[std::size_t(i)].second,
                 after = jets[std::size_t(i + 1)].second;
    if (ranges.smooth >= 3) {
      ASSERT_TRUE(holds(ranges.derivative(3), (after - before) / (2 * h), size / h * 1e-5, "third"))
          << name << " in " << from << " .. " << to;
    }
    if (ranges.smooth >= 4) {
      ASSERT_TRUE(holds(ranges.derivative(4), (after - 2 * at + before) / (h * h), size / (h * h) * 1e-5, "fourth"))
          << name << " in " << from << " .. " << to;
    }
  }
}

TEST(Series, EnclosesRandomExpressionsAndTheirDerivatives) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::string formula = random_formula(random, 1 + i % 3);
    const auto law = varying_law(formula);
    if (!law) continue;
    const double from = random(-2, 2), length = std::pow(10, random(-2, 0.3));
    expect_enclosed(*law->code(), from, from + length, formula);
    if (HasFatalFailure()) return;
  }
}

TEST(Series, EnclosesTablesAndTheirDerivatives) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    std::vector<double> t = {random(-1, 1)}, x = {random(-1, 1)};
    for (int row = 1 + random.below(8) + 2; row > 0; --row)
      t.push_back(t.back() + random(0.05, 0.5)), x.push_back(random(-1, 1));
    if (random.below(2) == 0) x.back() = x.front();
    constexpr Beyond beyond[] = {Beyond::hold, Beyond::zero, Beyond::repeat};
    const Beyond after = beyond[random.below(3)];
    const bool of_values = random.below(2) == 0;
    const TabulatedLaw law =
        of_values ? TabulatedLaw::of_values(t, x, after) : TabulatedLaw::of_accelerations(t, x, after);
    const double from = random(-2, 5);
    expect_enclosed(law, from, from + std::pow(10, random(-2, 0.5)), fmt::format("table {}", i));
    if (HasFatalFailure()) return;
  }
}

// Overestimation is of second order in the length: slowly varying laws need no short steps.
TEST(Series, RangesOfAShortIntervalAreNearlyTheValues) {
  for (const char* formula :
       {"sin(3*t)*exp(-t)", "t^3-2*t", "atan2(sin(t), 2+cos(t))", "sqrt(1+t^2)/(2+t)", "2^t", "tanh(t)"}) {
    const TimeFunction law = law_of(formula);
    const Series ranges = law.code()->enclose({0.7, 0.7 + 1e-6}, 2);
    const Jet jet = law.jet(0.7);
    EXPECT_NEAR(ranges.derivative(0).lower(), jet.value, 1e-4) << formula;
    EXPECT_NEAR(ranges.derivative(0).upper(), jet.value, 1e-4) << formula;
    EXPECT_NEAR(ranges.derivative(2).lower(), jet.second, 1e-3) << formula;
    EXPECT_NEAR(ranges.derivative(2).upper(), jet.second, 1e-3) << formula;
  }
}

// The largest distance of a law's value from the cubic of its ends, and by how much the cubic's ends and middle differ.
struct Departure {
  double off = 0, variation = 0, size = 0;
};
Departure departure(const TimeFunction& law, double t, double h) {
  const Jet a = law.jet(t), b = law.jet(t + h);
  const double middle = (a.value + b.value) / 2 + h / 8 * (a.rate - b.rate);
  Departure all;
  all.variation = std::max({a.value, b.value, middle}) - std::min({a.value, b.value, middle});
  all.size = std::max(std::abs(a.value), std::abs(b.value));
  for (int i = 1; i < 50; ++i) {
    const double s = i / 50.0, u = 1 - s;
    const double cubic =
        u * u * ((1 + 2 * s) * a.value + s * h * a.rate) + s * s * ((1 + 2 * u) * b.value - u * h * b.rate);
    all.off = std::max(all.off, std::abs(law(t + s * h) - cubic));
  }
  return all;
}

TEST(StepThatShowsALaw, HasItsCubicAtTheLaw) {
  Random random(3);
  int shown = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string formula = random_formula(random, 1 + i % 3);
    const auto varying = varying_law(formula);
    if (!varying) continue;
    const TimeFunction& law = *varying;
    const double t = random(-2, 2), longest = std::pow(10, random(-2, 1)), least = 1e-4;
    const double h = step_that_shows({law, 0, false}, t, longest, least);
    if (!(h >= 2 * least) || !std::isfinite(law(t)) || !std::isfinite(law(t + h))) continue;
    const Departure found = departure(law, t, h);
    // Of the largest value within `longest` of t, 1e-8 count as nothing; 1e-12: round-off of values of 1.
    double largest = found.size;
    for (double step = longest; step > h / 2; step /= 2)
      for (const double at : {t - step, t + step})
        if (std::isfinite(law(at))) largest = std::max(largest, std::abs(law(at)));
    ASSERT_LE(found.off, std::max(0.05 * found.variation, 1e-8 * largest) + 1e-12 * (1 + found.size))
        << formula << " from " << t << " over " << h;
    ++shown;
  }
  EXPECT_GT(shown, 10000);
}

// Step after step, each as long as shown.
std::vector<double> steps_that_show(const LawOfTime& law, double from, double until, double longest, double least) {
  std::vector<double> times = {from};
  while (times.back() < until) times.push_back(times.back() + step_that_shows(law, times.back(), longest, least));
  return times;
}

TEST(StepThatShowsALaw, OverlooksNoPulseHoweverShort) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const double at = random(0.2, 0.8), width = std::pow(10, random(-7, -1));
    for (const char* shape : {"exp(-((t-{0:.17g})/{1:.17g})^2)", "1/(1+((t-{0:.17g})/{1:.17g})^2)",
                              "max(0,1-abs(t-{0:.17g})/{1:.17g})", "step(t-{0:.17g})-step(t-{0:.17g}-{1:.17g})"}) {
      const TimeFunction law = law_of(fmt::format(fmt::runtime(shape), at, width));
      const auto times = steps_that_show({law, 0, false}, 0, 1, 0.5, 1e-9);
      double most = 0;
      for (const double t : times) most = std::max(most, law(t));
      EXPECT_GT(most, 0.25) << law.text() << shape << " at " << at << " of width " << width;
      EXPECT_LT(times.size(), 1000U) << shape << " at " << at << " of width " << width;
    }
  }
}

TEST(StepThatShowsALaw, IsAsLongAsProposedForSlowLaws) {
  for (const char* formula : {"3*t", "1+t^2", "t^3", "exp(t)", "sin(t)", "1e-14*sin(1e6*t)+5"})
    EXPECT_EQ(step_that_shows({law_of(formula), 0, false}, 0.1, 0.4, 1e-9), 0.4) << formula;
}

// After its last row an acceleration is 0 or constant, and velocity and place go on.
TEST(StepThatShowsALaw, IsAsLongAsProposedBeyondATable) {
  for (const Beyond beyond : {Beyond::hold, Beyond::zero}) {
    const auto code =
        std::make_shared<TabulatedLaw>(TabulatedLaw::of_accelerations({0, 1, 2, 3}, {0, 1, -1, 2}, beyond));
    EXPECT_EQ(step_that_shows({TimeFunction(code, ""), 2, false}, 4, 0.4, 1e-9), 0.4);
  }
}

TEST(StepThatShowsALaw, NeedsAPartOfTheDistanceOfRowsOfATable) {
  for (const Beyond beyond : {Beyond::hold, Beyond::zero, Beyond::repeat})
    for (const bool of_values : {true, false}) {
      const std::vector<double> t = {0, 1, 2, 3, 4}, x = {0, 1, -1, 2, 0};
      const auto code = std::make_shared<TabulatedLaw>(of_values ? TabulatedLaw::of_values(t, x, beyond)
                                                                 : TabulatedLaw::of_accelerations(t, x, beyond));
      for (double at = 0.05; at < 3.9; at += 0.1)
        EXPECT_GT(step_that_shows({TimeFunction(code, ""), 2, false}, at, 0.1, 1e-9), 0.02) << at;
    }
}

TEST(StepThatShowsALaw, ShowsDerivativesThatEnterTheEquations) {
  const TimeFunction law = law_of("t^2+1e-6*sin(1e3*t)");  // its acceleration is 2 - sin(1e3 t)
  EXPECT_GT(step_that_shows({law, 0, false}, 1, 0.4, 1e-9), 0.1);
  EXPECT_LT(step_that_shows({law, 2, false}, 1, 0.4, 1e-9), 0.005);
}

// A marker on a base that turns at constant speed moves to and fro.
TEST(StepThatShowsALaw, ShowsTheTurnsOfAnAngle) {
  const TimeFunction law = law_of("100*t");
  EXPECT_EQ(step_that_shows({law, 2, false}, 0, 1, 1e-9), 1);
  EXPECT_LT(step_that_shows({law, 2, true}, 0, 1, 1e-9), 0.04);
}

TEST(StepThatShowsALaw, IsTheLeastOneAcrossAJump) {
  const TimeFunction law = law_of("step(t-0.5)");
  EXPECT_EQ(step_that_shows({law, 0, false}, 0, 0.5 - 1e-3, 1e-6), 0.5 - 1e-3);  // ends before
  const double h = step_that_shows({law, 0, false}, 0.5 - 1e-7, 1, 1e-6);
  EXPECT_GE(h, 1e-6);
  EXPECT_LT(h, 2e-6);
}

}  // namespace
}  // namespace trammel::scene
