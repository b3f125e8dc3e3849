#include "scene/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trammel::scene {
namespace {

double lookup(std::string_view name, int column) {
  if (name == "E") return 7e10;
  throw ExpressionError(column, "no parameter");
}

TEST(Expression, FollowsTheUsualPrecedence) {
  EXPECT_DOUBLE_EQ(evaluate("1 + 2*3 - 4/8", lookup), 6.5);
  EXPECT_DOUBLE_EQ(evaluate("-2^2", lookup), -4);
  EXPECT_DOUBLE_EQ(evaluate("2^3^2", lookup), 512);
  EXPECT_DOUBLE_EQ(evaluate("2^-1", lookup), 0.5);
  EXPECT_DOUBLE_EQ(evaluate("(1 + 2)*3", lookup), 9);
  EXPECT_DOUBLE_EQ(evaluate("2e-3*E", lookup), 1.4e8);
  EXPECT_DOUBLE_EQ(evaluate("atan2(1, -1)", lookup), 3 * M_PI / 4);
}

TEST(Expression, NamesTheColumnOfAMistake) {
  const auto column = [](const char* text) {
    try {
      evaluate(text, lookup);
    } catch (const ExpressionError& error) {
      return error.column();
    }
    return 0;
  };
  EXPECT_EQ(column("1 + "), 5);
  EXPECT_EQ(column("1 + foo"), 5);
  EXPECT_EQ(column("sin(1"), 6);
  EXPECT_EQ(column("2 $ 3"), 3);
  EXPECT_EQ(column("1/0"), 1);
  EXPECT_EQ(column("2*t"), 3);
}

TEST(Expression, RefusesEndlessNesting) {
  EXPECT_THROW(evaluate(std::string(100000, '('), lookup), ExpressionError);
  EXPECT_THROW(evaluate("2" + std::string(100000, '^'), lookup), ExpressionError);
  EXPECT_DOUBLE_EQ(evaluate(std::string(100000, '-') + "1", lookup), 1);
}

// Every function against central differences of its value and of its rate.
class JetOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Functions, JetOf,
                         testing::Values("0.3*sin(2*pi*t)", "cos(t)^3", "tan(t/3)", "asin(t/4)", "acos(t/4)", "atan(t)",
                                         "atan2(t, 1 + t*t)", "sinh(t)", "cosh(t)", "tanh(t)", "exp(-t)/t",
                                         "log(1 + t)", "sqrt(t)", "abs(1 - t)", "t^2.5", "t^t", "min(t, 2*t - 0.5)",
                                         "max(t, t*t)", "-t^4 + 3*t", "pow(t, 3)", "sign(t)*t", "step(t - 0.1)*t",
                                         "floor(t) + ceil(t)*t"));

TEST_P(JetOf, RatesAreDerivatives) {
  const TimeFunction law = compile_time_function(GetParam(), lookup);
  const double t = 1.3, s = 1e-5;  // truncation s^2, round-off eps/s
  const auto jet = law.jet(t);
  EXPECT_DOUBLE_EQ(jet.value, law(t));
  EXPECT_NEAR(jet.rate, (law(t + s) - law(t - s)) / (2 * s), 1e-7);
  EXPECT_NEAR(jet.second, (law.jet(t + s).rate - law.jet(t - s).rate) / (2 * s), 1e-7);
}

TEST(TimeFunction, WithoutTIsAConstant) {
  EXPECT_TRUE(compile_time_function("2*pi", lookup).is_constant());
}

}  // namespace
}  // namespace trammel::scene
