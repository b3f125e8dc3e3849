// Laws of time from tables, and where laws jump.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "scene/expression.hpp"
#include "scene/laws/continuity.hpp"
#include "scene/laws/tabulated_law.hpp"
#include "scene/value.hpp"

#include "folder.hpp"

namespace trammel::scene {
namespace {

using std::numbers::pi;
using Jet = TimeFunction::Jet;

// sin^4: it and its first two derivatives are 0 at 0 and at pi, as the spline's ends.
Jet pulse(double t) {
  const double s = std::sin(t), c = std::cos(t);
  return {s * s * s * s, 4 * s * s * s * c, 12 * s * s * c * c - 4 * s * s * s * s};
}

struct Samples {
  std::vector<double> t, x;
};
Samples sampled(int rows, const std::function<double(double)>& x) {
  Samples samples;
  for (int i = 0; i < rows; ++i) samples.t.push_back(pi * i / (rows - 1)), samples.x.push_back(x(samples.t.back()));
  return samples;
}

double largest_error(const TabulatedLaw& law, double Jet::*part) {
  double largest = 0;
  for (double t = 0; t < pi; t += 0.0123) largest = std::max(largest, std::abs(law.jet(t).*part - pulse(t).*part));
  return largest;
}

TEST(TabulatedLaw, PassesThroughItsRows) {
  const Samples samples = sampled(20, [](double t) { return pulse(t).value; });
  const TabulatedLaw law = TabulatedLaw::of_values(samples.t, samples.x);
  for (std::size_t i = 0; i < samples.t.size(); ++i) EXPECT_NEAR(law.jet(samples.t[i]).value, samples.x[i], 1e-15);
}

// The quintic spline is of order 6, each derivative of one less; rows at half the distance divide the errors by 64, 32,
// 16. Ratios are within 15 % of that between these tables.
TEST(TabulatedLaw, OfValuesIsOfOrderSix) {
  const auto law = [](int rows) {
    const Samples samples = sampled(rows, [](double t) { return pulse(t).value; });
    return TabulatedLaw::of_values(samples.t, samples.x);
  };
  const TabulatedLaw coarse = law(65), fine = law(129);
  EXPECT_NEAR(std::log2(largest_error(coarse, &Jet::value) / largest_error(fine, &Jet::value)), 6, 0.2);
  EXPECT_NEAR(std::log2(largest_error(coarse, &Jet::rate) / largest_error(fine, &Jet::rate)), 5, 0.2);
  EXPECT_NEAR(std::log2(largest_error(coarse, &Jet::second) / largest_error(fine, &Jet::second)), 4, 0.2);
}

TEST(TabulatedLaw, OfAccelerationsIsTheirSecondIntegral) {
  const auto error = [](int rows) {
    const Samples samples = sampled(rows, [](double t) { return pulse(t).second; });
    return largest_error(TabulatedLaw::of_accelerations(samples.t, samples.x), &Jet::value);
  };
  // The natural ends of the cubic spline (its bend is 0 there, that of sin^4'' is 24) leave order 2 in the acceleration
  // of the outermost pieces, whose part in the displacement is of order 3.
  EXPECT_LT(error(257), 1e-5);
  EXPECT_NEAR(std::log2(error(129) / error(257)), 3, 0.2);
}

// Rows at unlike distances: the first four derivatives are the same from both sides of each row.
TEST(TabulatedLaw, IsFourTimesContinuouslyDifferentiable) {
  const std::vector<double> t = {0, 0.3, 0.5, 1.1, 1.2, 2}, x = {0, 1, -0.5, 0.3, 0.7, 0.2};
  for (const TabulatedLaw& law : {TabulatedLaw::of_values(t, x), TabulatedLaw::of_accelerations(t, x)})
    for (std::size_t i = 1; i + 1 < t.size(); ++i) {
      const double h = 1e-4;
      const Jet before = law.jet(t[i] - 1e-12), after = law.jet(t[i] + 1e-12);
      EXPECT_NEAR(before.value, after.value, 1e-9);
      EXPECT_NEAR(before.rate, after.rate, 1e-8);
      EXPECT_NEAR(before.second, after.second, 1e-6);
      // One-sided differences, each half a step off: they differ by h times the next derivative, of 1e4 at most here.
      const auto third = [&](double step) { return (law.jet(t[i] + step).second - law.jet(t[i]).second) / step; };
      const auto fourth = [&](double step) {
        return (law.jet(t[i] + 2 * step).second - 2 * law.jet(t[i] + step).second + law.jet(t[i]).second) /
               (step * step);
      };
      EXPECT_NEAR(third(-h), third(h), 2) << i;
      EXPECT_NEAR(fourth(-h), fourth(h), 10) << i;
    }
}

TEST(TabulatedLaw, RestsBeforeItsFirstRowAndAfterItsLast) {
  const TabulatedLaw law = TabulatedLaw::of_values({1, 2, 3, 4}, {5, 6, 5, 7});
  for (const double t : {-10.0, 1.0, 4.0, 20.0}) {
    const Jet jet = law.jet(t);
    EXPECT_NEAR(jet.value, t < 2 ? 5 : 7, 1e-14);
    EXPECT_NEAR(jet.rate, 0, 1e-13);
    EXPECT_NEAR(jet.second, 0, 1e-12);
  }
}

using Beyond = TabulatedLaw::Beyond;

TEST(TabulatedLaw, HoldsTheColumnBeyondItsRows) {
  const TabulatedLaw values = TabulatedLaw::of_values({1, 2, 3, 4}, {5, 6, 5, 7}, Beyond::hold);
  EXPECT_EQ(values.jet(-3).value, 5);
  EXPECT_EQ(values.jet(40).value, 7);
  // a = 3 t: v = 1.5 (t^2 - 1), x = t^3/2 - 1.5 t + 1 from t = 1; then a = 12 on, and 3 before.
  const TabulatedLaw law = TabulatedLaw::of_accelerations({1, 2, 3, 4}, {3, 6, 9, 12}, Beyond::hold);
  EXPECT_NEAR(law.jet(6).second, 12, 1e-12);
  EXPECT_NEAR(law.jet(6).rate, 22.5 + 24, 1e-12);
  EXPECT_NEAR(law.jet(6).value, 27 + 2 * 22.5 + 24, 1e-11);
  EXPECT_NEAR(law.jet(-1).second, 3, 1e-12);
  EXPECT_NEAR(law.jet(-1).rate, -6, 1e-12);
  EXPECT_NEAR(law.jet(-1).value, 6, 1e-12);
}

TEST(TabulatedLaw, IsZeroBeyondItsRows) {
  const TabulatedLaw values = TabulatedLaw::of_values({1, 2, 3, 4}, {5, 6, 5, 7}, Beyond::zero);
  for (const double t : {0.999, 4.001, 50.0}) EXPECT_EQ(values.jet(t).value, 0) << t;
  const TabulatedLaw law = TabulatedLaw::of_accelerations({1, 2, 3, 4}, {3, 6, 9, 12}, Beyond::zero);
  EXPECT_EQ(law.jet(6).second, 0);
  EXPECT_NEAR(law.jet(6).rate, 22.5, 1e-12);
  EXPECT_NEAR(law.jet(6).value, 27 + 45, 1e-11);
  EXPECT_EQ(law.jet(0.5).value, 0);
}

// A sine from any row on, in rows at unlike distances: the periodic spline knows no ends, so it is as good there as
// within.
TEST(TabulatedLaw, RepeatsValuesWithoutASeam) {
  const double T = 1.7;
  std::vector<double> t, x;
  const auto exact = [T](double at) { return std::sin(2 * pi * at / T + 0.8); };
  for (int i = 0; i <= 60; ++i) {
    t.push_back(0.3 + T * (i / 60.0 + 0.003 * std::sin(2 * pi * 7 * i / 60)));
    x.push_back(exact(t.back()));
  }
  const TabulatedLaw law = TabulatedLaw::of_values(t, x, Beyond::repeat);
  const double w = 2 * pi / T;
  for (double at = -7; at < 12; at += 0.0137) {
    const Jet jet = law.jet(at);
    // 60 rows a period, order 6: (2 pi/60)^6/720 = 2e-9 of the value, and one order less for each derivative.
    EXPECT_NEAR(jet.value, exact(at), 1e-8);
    EXPECT_NEAR(jet.rate, w * std::cos(w * at + 0.8), 1e-6 * w);
    EXPECT_NEAR(jet.second, -w * w * std::sin(w * at + 0.8), 1e-4 * w * w);
  }
}

// What a period gains of velocity stays: x'' = 1 + sin(2 pi t) for ever.
TEST(TabulatedLaw, RepeatsAccelerationsAndKeepsTheVelocityGained) {
  std::vector<double> t, a;
  for (int i = 0; i <= 200; ++i) t.push_back(i / 200.0), a.push_back(1 + std::sin(2 * pi * t.back()));
  const TabulatedLaw law = TabulatedLaw::of_accelerations(t, a, Beyond::repeat);
  const double w = 2 * pi;
  for (double at = -2.3; at < 4; at += 0.0419) {
    const Jet jet = law.jet(at);
    const double v = at + (1 - std::cos(w * at)) / w, x = at * at / 2 + at / w - std::sin(w * at) / (w * w);
    EXPECT_NEAR(jet.second, 1 + std::sin(w * at), 1e-6);
    EXPECT_NEAR(jet.rate, v, 1e-7);
    EXPECT_NEAR(jet.value, x, 1e-6);
  }
}

TEST(TabulatedLaw, WhatJumpsIsSeenAsAJump) {
  const auto jump = [](Beyond beyond, std::vector<double> x, double until, int derivatives = 2) {
    const TimeFunction law(
        std::make_shared<const TabulatedLaw>(TabulatedLaw::of_values({0, 1, 2, 3}, std::move(x), beyond)), "");
    return find_jump(law, derivatives, 0, until);
  };
  ASSERT_TRUE(jump(Beyond::repeat, {0, 1, 2, 3}, 10));
  EXPECT_NEAR(jump(Beyond::repeat, {0, 1, 2, 3}, 10)->t, 3, 1e-12);
  EXPECT_NEAR(jump(Beyond::repeat, {0, 1, 2, 3}, 10)->by, -3, 1e-12);
  ASSERT_TRUE(jump(Beyond::zero, {0, 1, 2, 3}, 10));
  EXPECT_NEAR(jump(Beyond::zero, {0, 1, 2, 3}, 10)->by, -3, 1e-12);
  EXPECT_FALSE(jump(Beyond::repeat, {3, 1, 2, 3}, 100));
  EXPECT_FALSE(jump(Beyond::zero, {0, 1, 2, 0}, 10));
  EXPECT_FALSE(jump(Beyond::hold, {0, 1, 2, 3}, 10));
  EXPECT_FALSE(jump(Beyond::zero, {0, 1, 2, 3}, 2.9));
}

TEST(TabulatedLaw, SaysWhereItIsKnown) {
  const std::vector<double> t = {1, 2, 3, 4}, x = {0, 1, 0, 0};
  EXPECT_EQ(TabulatedLaw::of_values(t, x).span().begin, 1);
  EXPECT_EQ(TabulatedLaw::of_accelerations(t, x).span().end, 4);
  for (const Beyond beyond : {Beyond::hold, Beyond::zero, Beyond::repeat})
    EXPECT_FALSE(std::isfinite(TabulatedLaw::of_values(t, x, beyond).span().end));
}

struct Read {
  std::optional<TimeFunction> law;
  std::string problems;
};
Read read(const std::string& table, const std::string& entry) {
  const Folder folder("trammel_laws");
  folder.file("quake.csv", table);
  const Scene scene = Scene::load(folder.file("scene.json", "{\"x\": " + entry + "}"));
  Problems problems;
  Read result;
  result.law = scene.root().find("x")->read_time_function(problems);
  for (const Problem& problem : problems.errors()) result.problems += problem.text() + "\n";
  return result;
}

TEST(MotionTable, IsReadFromTheSceneFilesFolder) {
  const Read read_ =
      read("# El Centro\nt, a_x, a_y\n0, 0, 0\n1, 2, 0\n2, 3e-1, 0\n\n3, 0, 1\n", R"({"table": "quake.csv"})");
  ASSERT_TRUE(read_.law) << read_.problems;
  EXPECT_NEAR((*read_.law)(1), 2, 1e-15);
  EXPECT_EQ((*read_.law)(2), 0.3);
}

TEST(MotionTable, FindsColumnsByNameAndByNumber) {
  const char* table = "x;time;y\n5;0;0\n6;1;1\n7;2;0\n8;3;4\n";
  for (const char* entry : {R"({"table": "quake.csv", "time": "time", "column": "y", "scale": 10})",
                            R"({"table": "quake.csv", "time": 2, "column": 3, "scale": "=5+5"})"}) {
    const Read read_ = read(table, entry);
    ASSERT_TRUE(read_.law) << read_.problems;
    EXPECT_NEAR((*read_.law)(3), 40, 1e-13);
  }
}

// As spreadsheets write them: names in quotes with separators and quotes within, CR LF at the ends of lines, and a byte
// order mark.
TEST(MotionTable, NamesOfColumnsMayBeInDoubleQuotes) {
  for (const char* entry : {R"({"table": "quake.csv", "time": "t, s", "column": "the \"x\""})",
                            R"({"table": "quake.csv", "time": "t, s", "column": 2})"}) {
    const Read read_ = read("\xEF\xBB\xBF\"t, s\",\"the \"\"x\"\"\"\r\n\"0\",0\r\n1,\"1\"\r\n2,0\r\n3,4\r\n", entry);
    ASSERT_TRUE(read_.law) << read_.problems;
    EXPECT_NEAR((*read_.law)(3), 4, 1e-14);
  }
}

TEST(MotionTable, MayBeSeparatedByBlanks) {
  const Read read_ = read("0.0   1\n  1.0\t2 \n2.0 3\n3.0 4\n", R"({"table": "quake.csv", "holds": "accelerations"})");
  ASSERT_TRUE(read_.law) << read_.problems;
  EXPECT_DOUBLE_EQ(read_.law->jet(2).second, 3);
  EXPECT_NEAR(read_.law->jet(3).rate, 7.5, 1e-14);  // a = 1 + t
}

struct Wrong {
  const char *table, *entry, *message;
};
void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.entry;
}
class WrongTable : public testing::TestWithParam<Wrong> {};
TEST_P(WrongTable, IsRefusedWithItsPlace) {
  const Read read_ = read(GetParam().table, GetParam().entry);
  EXPECT_NE(read_.problems.find(GetParam().message), std::string::npos) << read_.problems;
}
const char* const good = "t,x\n0,0\n1,1\n2,0\n3,0\n";
INSTANTIATE_TEST_SUITE_P(
    All, WrongTable,
    testing::Values(
        Wrong{"t,x\n0,0\n1,1\n0.5,2\n3,4\n", R"({"table": "quake.csv"})",
              "quake.csv:4:1: x: the time 0.5 does not come after 1 in the row before"},
        Wrong{"t,x\n0,0\n1,1\n1,2\n3,4\n", R"({"table": "quake.csv"})",
              "quake.csv:4:1: x: the time 1 does not come after 1"},
        Wrong{"0,0\n1,1\n", R"({"table": "quake.csv"})", "quake.csv:2:1: x: found 2 rows, expected at least 4"},
        Wrong{"", R"({"table": "quake.csv"})", "found 0 rows"},
        Wrong{"0,0\n1,one\n2,2\n3,3\n", R"({"table": "quake.csv"})",
              "quake.csv:2:1: x: found \"one\", expected a number"},
        Wrong{"0,0\n1,nan\n2,2\n3,3\n", R"({"table": "quake.csv"})", "found \"nan\", expected a number"},
        Wrong{"0,0\n1\n2,2\n3,3\n", R"({"table": "quake.csv"})",
              "quake.csv:2:1: x: found 1 cells, expected at least 2"},
        Wrong{good, R"({"table": "quake.csv", "column": "y"})", "has no column \"y\"; known: t, x"},
        Wrong{"t,x,x\n0,0,1\n1,1,2\n2,0,3\n3,0,4\n", R"({"table": "quake.csv", "column": "x"})",
              "has more than one column \"x\"; give the number of the one that is meant, from 1"},
        Wrong{"t,t,x\n0,0,1\n1,1,2\n2,0,3\n3,0,4\n", R"({"table": "quake.csv", "time": "t", "column": "x"})",
              "has more than one column \"t\""},
        Wrong{"\"t,x\n0,0\n1,1\n2,0\n3,0\n", R"({"table": "quake.csv"})",
              "quake.csv:1:1: x: a double quote is not closed on its line"},
        Wrong{good, R"({"table": "quake.csv", "column": 3})", "found column 3, but"},
        Wrong{good, R"({"table": "quake.csv", "time": 0})", "found column 0, but"},
        Wrong{good, R"({"table": "quake.csv", "holds": "acceleration"})",
              "found \"acceleration\", expected \"values\" or \"accelerations\""},
        Wrong{good, R"({"table": "quake.csv", "beyond": "repaet"})",
              "found \"repaet\", expected \"hold\", \"zero\" or \"repeat\""},
        Wrong{good, R"({"table": "quake.csv", "column": "t"})", "column \"t\" of"},
        Wrong{good, R"({"table": "quake.csv", "column": 1})", "is taken for the time and for what moves"},
        Wrong{good, R"({"table": "quake.csv", "time": "x"})", "column \"x\" of"},
        Wrong{good, R"({"table": "quack.csv"})", "cannot read the table \"quack.csv\""},
        Wrong{good, R"({"table": "quake.csv", "colum": 2})", "unknown key \"colum\""},
        Wrong{good, R"({"file": "quake.csv"})", "expected a number, an expression of t or {\"table\": FILE, ...}"}));

TimeFunction law(const char* text) {
  return compile_time_function(text, [](std::string_view, int) { return 0.0; });
}

TEST(Continuity, JumpsOfTheValueAndOfTheRateAreFoundToTheLastDigit) {
  const auto step = find_jump(law("step(t - 0.7)"), 1, 0, 2);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->t, 0.7);
  EXPECT_EQ(step->derivative, 0);
  EXPECT_DOUBLE_EQ(step->by, 1);
  const auto corner = find_jump(law("abs(sin(t))"), 2, 0.1, 4);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->t, pi, 1e-15);
  EXPECT_EQ(corner->derivative, 1);
  EXPECT_NEAR(corner->by, 2, 1e-12);
}

TEST(Continuity, ACornerIsNoJumpOfTheValue) {
  EXPECT_FALSE(find_jump(law("max(0, t - 1)"), 1, 0, 2));
}

TEST(Continuity, AJumpOfTheLastDerivativeIsAllowed) {
  EXPECT_FALSE(find_jump(law("max(0, t - 1)^2"), 2, 0, 2));
  EXPECT_FALSE(find_jump(law("step(t - 1)*(t - 1)^2"), 2, 0, 2));
}

TEST(Continuity, ASwitchThatIsThrownAtTheStartIsNoJump) {
  EXPECT_FALSE(find_jump(law("step(t)*sin(t)"), 2, 0, 2));
}

TEST(Continuity, ALawWithoutSwitchesHasNoJump) {
  EXPECT_FALSE(find_jump(law("1/(t - 1)"), 2, 0, 2));
}

TEST(TimeFunction, CountsAsZeroWhereItsSquareWouldUnderflow) {
  EXPECT_EQ(law("exp(-(t/0.01)^2)").jet(-0.2).value, 0);  // 1e-174
  EXPECT_GT(law("exp(-(t/0.01)^2)").jet(-0.1).value, 0);  // 1e-44
}

}  // namespace
}  // namespace trammel::scene
