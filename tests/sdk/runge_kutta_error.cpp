#include <gtest/gtest.h>

#include <trammel/methods/runge_kutta.hpp>
#include <trammel/testing/archive.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel {
namespace {

RungeKutta on_rows() {
  RungeKutta method({1, nullptr, nullptr, nullptr});
  method.rows = RungeKutta::Rows::projected;
  return method;
}

// Of a trial from t to t + h whose error is `whole`, and 0.5 along the rows.
double error(RungeKutta& method, double t, double h, double whole) {
  State now, next;
  now.t = t, next.t = t + h;
  return method.error(now, next, [&](RungeKutta::Part part) { return part == RungeKutta::Part::whole ? whole : 0.5; });
}

TEST(RungeKuttaError, IsThatOfTheWholeWhileItFallsWithTheStep) {
  RungeKutta method = on_rows();
  EXPECT_EQ(error(method, 1, 0.1, 1000), 1000);
  EXPECT_EQ(error(method, 1, 0.05, 200), 200);
  EXPECT_EQ(error(method, 1, 0.04, 0.9), 0.9);
  EXPECT_EQ(error(method, 1.04, 0.04, 1000), 1000) << "a first trial has nothing to be compared with";
}

TEST(RungeKuttaError, IsThatAlongTheRowsFromWhereTheWholeDoesNotFallToWhereItIsSmall) {
  RungeKutta method = on_rows();
  EXPECT_EQ(error(method, 1, 0.1, 1000), 1000);
  EXPECT_EQ(error(method, 1, 0.05, 300), 0.5);
  EXPECT_EQ(error(method, 1.05, 0.05, 1e6), 0.5);
  EXPECT_EQ(error(method, 1.1, 0.05, 0.7), 0.7);
  EXPECT_EQ(error(method, 1.15, 0.05, 300), 300);
}

TEST(RungeKuttaError, IsThatOfTheWholeWithBaumgartesTerms) {
  RungeKutta method = on_rows();
  method.rows = RungeKutta::Rows::baumgarte;
  EXPECT_EQ(error(method, 1, 0.1, 1000), 1000);
  EXPECT_EQ(error(method, 1, 0.05, 1000), 1000);
}

TEST(RungeKuttaError, GoesOnInAResumedRunAndBeginsAnewWithAMotion) {
  RungeKutta method = on_rows(), resumed = on_rows();
  error(method, 1, 0.1, 1000), error(method, 1, 0.05, 1000);
  MemoryArchive memory;
  method.archive(memory);
  memory.reading = true;
  resumed.archive(memory);
  EXPECT_EQ(error(resumed, 1.05, 0.05, 1000), 0.5);
  resumed.forget();
  EXPECT_EQ(error(resumed, 1.1, 0.05, 1000), 1000);
}

TEST(RungeKuttaError, BeginsAnewWithAMotion) {
  RungeKutta method = on_rows();
  error(method, 1, 0.1, 1000);
  ASSERT_EQ(error(method, 1, 0.05, 1000), 0.5);
  const Problem problem = problems::pendulum_with_rod();
  const auto system = problem.system();
  Slope slope;
  method.begin(*system, problem.solution(0), slope);
  EXPECT_EQ(error(method, 1.05, 0.05, 1000), 1000);
}

constexpr double half[] = {0, 0.5}, weights_of_half[] = {0.5}, midpoint[] = {0, 1};

// Where a dense output lacks a slope, a shorter step takes its place; without that there is no number.
TEST(RungeKuttaSteps, AreShorterInsideAStep) {
  bool fails = false;
  Problem p;
  p.closed_form = false;
  p.M = Mat::Ones(1, 1);
  p.force = [&fails](double t, const Vec& q, const Vec&) { return Vec::Constant(1, fails ? 1e200 : t - 2 * q[0]); };
  p.exact = [](double, Vec& q, Vec& v) { q = Vec::Constant(1, 1), v = Vec::Constant(1, 3); };
  const auto system = p.system();
  const State now{0.25, Vec::Constant(1, 1), Vec::Constant(1, 3), Vec::Constant(1, 0.25 - 2), Vec(0)};
  RungeKutta method({2, half, weights_of_half, midpoint}), other({2, half, weights_of_half, midpoint});
  State next, inside, expected;
  Slope first;
  method.begin(*system, now, first);
  ASSERT_TRUE(method.step(*system, now, first, 0.5, next).accepted());
  method.step_inside(*system, now, next, 0.25, inside);
  other.begin(*system, now, first);
  ASSERT_TRUE(other.step(*system, now, first, 0.125, expected).accepted());
  EXPECT_EQ(inside.t, 0.375);
  EXPECT_EQ(inside.q, expected.q);
  EXPECT_EQ(inside.v, expected.v);
  EXPECT_NEAR(inside.v[0], 3 + 0.125 * (0.25 + 0.0625 - 2 * (1 + 0.0625 * 3)), 1e-15);  // the midpoint rule
  fails = true;
  method.step_inside(*system, now, next, 0.25, inside);
  EXPECT_EQ(inside.t, 0.375);
  EXPECT_TRUE(inside.q.array().isNaN().all() && inside.v.array().isNaN().all());
  EXPECT_EQ(inside.q.size() + inside.v.size(), 2);
}

// q i turns about the first axis of the body; an error along q itself changes nothing but the quaternion's length.
TEST(RungeKuttaError, IsThatOfTheRotationAndNotOfTheLengthOfAQuaternion) {
  const Problem top = problems::heavy_top();
  const auto system = top.system();
  const Vec q = top.solution(0).q, qi = Eigen::Vector4d(-q[1], q[0], q[3], -q[2]);
  const double small = 1e-6;
  Vec embedded, increment;
  for (const double along : {0.0, 0.5}) {
    error_increment(*system, q, along * q + small * qi, embedded, increment);
    EXPECT_NEAR((increment - 2 * small / (1 - along) * Vec::Unit(3, 0)).norm(), 0, 1e-11) << along;
  }
}

}  // namespace
}  // namespace trammel
