// Where a step's iteration ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "trapezoidal_step.hpp"

namespace trammel::test {
namespace {

// Largest error of a, and where Newton's iteration should end.
struct Ended {
  double error, allowed;
  int factorisations;
};
// Of one coordinate of `springs`. `scale_q`, `scale_v`: by what the changes of its place and of velocities count.
Ended ended(const Springs& springs, int coordinate, double h, double scale_q, double scale_v,
            double tolerance = 1e-11) {
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), h);
  t.step.newton.max_iterations = 100;
  t.step.newton.tolerance = tolerance;
  t.begin();
  const double at_first = std::abs(t.next.a[coordinate] - t.exact(springs)[coordinate]);
  const int increments = t.iterate();
  EXPECT_TRUE(t.step.newton.converged());
  const double a = std::abs(t.next.a[coordinate]), largest = t.next.a.lpNorm<Eigen::Infinity>();
  const double error = std::abs(t.next.a[coordinate] - t.exact(springs)[coordinate]);
  EXPECT_NEAR(error, at_first * std::pow(springs.theta, increments), 0.01 * error) << "a residual without an increment";
  return {error, tolerance * std::min((scale_q + t.c_q * a) / t.c_q, (scale_v + t.c_v * largest) / t.c_v),
          springs.factorisations};
}
// The remaining error is below the allowed one, and was above it one iteration earlier. The first factors are
// sufficient: the residual that they leave does not matter.
void expect_just_below(const Ended& ended, double theta) {
  EXPECT_LE(ended.error, 1.001 * ended.allowed);  // round-off of differences of a: 1e-16 beside 1e-11
  EXPECT_GE(ended.error, 0.999 * theta * ended.allowed);
  EXPECT_EQ(ended.factorisations, 1);
}

constexpr double theta = 0.2;

// Beside a coordinate that is far away and fast: all lengths and velocities together are 1e6 times its own.
Springs beside_a_fast_one(double q, double v, double rest = 0) {
  return {.k = Eigen::Vector2d(0, 1),
          .rest = Eigen::Vector2d(0, rest),
          .q = Eigen::Vector2d(1e6, q),
          .v = Eigen::Vector2d(1e6, v),
          .theta = theta};
}

TEST(NewmarkStep, EndsAtItsToleranceOfAMetreOrARadianOfEachCoordinate) {
  expect_just_below(ended(beside_a_fast_one(0.1, 0), 1, 1, 1, 4e6), theta);
}

TEST(NewmarkStep, EndsAtItsToleranceOfTheChangeOfACoordinateThatMovesFar) {
  const double q = 100, v = 1000, h = 1, a = q;
  const double change = h * v + h * h * a + std::abs(h * v - h * h / 4 * a);
  expect_just_below(ended(beside_a_fast_one(q, v), 1, h, change, 4e6), theta);
}

TEST(NewmarkStep, EndsAtTheRoundOffOfACoordinate) {
  const double far = 1e6;
  expect_just_below(ended(beside_a_fast_one(far, 0, far - 1), 1, 1, 64 * eps / 1e-11 * far, 4e6), theta);
}

// Entries of q that do not belong to those of v: the largest one counts for all.
TEST(NewmarkStep, EndsAtTheRoundOffOfTheLargestNumberWhereCoordinatesAreNotVelocities) {
  const Springs springs{.k = Eigen::Vector2d(1, 0),
                        .rest = Vec::Zero(2),
                        .q = Eigen::Vector2d(0.1, 0),
                        .v = Eigen::Vector2d(0, 1e6),
                        .theta = theta,
                        .coordinates_beside = 1};
  expect_just_below(ended(springs, 0, 1, 64 * eps / 1e-11 * 1e6, 2e6), theta);
}

TEST(NewmarkStep, EndsAtItsToleranceOfTheVelocities) {
  const double v = 2, h = 1e-3;
  Springs springs = one_spring(1e4, 1, v);
  springs.theta = theta;
  // a = -1e4 m/s^2: its v is 2 m/s at the start, and changes by 10 m/s.
  const double size_v = v + h * 1e4 + std::abs(v - h / 2 * 1e4);
  for (const double tolerance : {1e-11, 1.5e-11, 2.2e-11, 3.3e-11})  // an increment leaves a fifth
    expect_just_below(ended(Springs(springs), 0, h, 1, size_v, tolerance), theta);
}

// The first increment after a prediction measures the step's own error.
TEST(NewmarkStep, EndsAtAThousandthOfTheFirstIncrementAfterAPrediction) {
  for (const double factor : {0.05, 0.08, 0.09}) {
    Springs springs = one_spring(0.04, 1, 1);
    springs.theta = factor;
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1);
    t.begin({Vec::Constant(1, -0.03), 1});
    const double wrong = std::abs(t.next.a[0] - t.exact(springs)[0]), first = (1 - factor) * wrong;
    EXPECT_EQ(t.iterate(), 3);
    const double left = std::abs(t.next.a[0] - t.exact(springs)[0]);
    EXPECT_LE(left, 1e-3 * first);
    EXPECT_GE(left / factor, 1e-3 * first);
    EXPECT_EQ(springs.factorisations, 1);
  }
}

// Nothing moves along x at first, but y is off its plane, which changes the force along x.
TEST(NewmarkStep, DoesNotEndBeforePositionsAreOnTheirRows) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(1e6, 1e-6), .v = Eigen::Vector2d(1, 0)};
  springs.force = [](const Vec& q) { return Eigen::Vector2d(1e6 * q[1], 0); };
  springs.rows = [](const Vec& q, const Vec&) {
    return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  EXPECT_NEAR(t.now.a[0], 1, 8 * eps);
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_EQ(t.next.q[1], 0);
  EXPECT_LE(std::abs(t.next.a[0]), 1e-9);  // 1e6 times the round-off of y
}

TEST(NewmarkStep, SatisfiesLinearRowsByItsFirstIncrement) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0, 1e-3), .v = Eigen::Vector2d(1, 0.5)};
  springs.rows = [](const Vec& q, const Vec&) {
    return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 0.1);
  t.begin();
  t.correct();
  t.residual();
  EXPECT_LE(std::abs(s->g()[0]), 1e-16);
  EXPECT_LE(std::abs(s->g_dot()[0]), 1e-16);
}

TEST(NewmarkStep, HasNothingToFindWithoutVelocities) {
  Springs nothing{.k = Vec(0), .rest = Vec(0), .q = Vec(0), .v = Vec(0)};
  const auto s = nothing.system();
  Trapezoidal t(*s, State{0, Vec(0), Vec(0), Vec(0), Vec(0)}, 1);
  t.begin({Vec(0), 1});
  EXPECT_FALSE(t.step.iterating());
  EXPECT_TRUE(t.step.finish(*s, t.now, t.next));
}

// --- Round-off ---

// Positions resolve 1e-13 m, so forces 1e-7 N, far more than the tolerance of a velocity of a micrometre per second.
TEST(NewmarkStep, AcceptsForcesThatAreTheRoundOffOfFarPositions) {
  for (int i = 0; i < 40; ++i) {
    Springs springs = one_spring(1e6, 1e3, 1e-6 * std::sin(i));
    springs.rest[0] = 1e3;
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1e-3);
    t.begin();
    t.iterate();
    EXPECT_TRUE(t.step.finish(*s, t.now, t.next)) << i;
  }
}

// A force of 1e6 N on a slope: what its rounding leaves along the slope is all that could move, also where springs do
// not let it.
TEST(NewmarkStep, AcceptsRestUnderForcesThatRowsCarry) {
  for (const double k : {0, 4})
    for (int i = 1; i < 40; ++i) {
      const Eigen::Vector2d n(std::sin(0.03 * i), std::cos(0.03 * i)), F = 1e6 / 3.0 * n;
      Springs springs{.k = Vec::Constant(2, k), .rest = Vec::Zero(2), .q = Vec::Zero(2), .v = Vec::Zero(2)};
      springs.force = [F, k](const Vec& q) { return F - k * q; };
      springs.rows = [n](const Vec& q, const Vec&) {
        return Problem::Rows{Vec::Constant(1, n.dot(q)), Vec::Zero(1), Vec::Zero(1), n.transpose()};
      };
      const auto s = springs.system();
      State now = springs.start(*s);
      now.a.setZero();
      Trapezoidal t(*s, now, 1);
      t.begin();
      t.iterate();
      EXPECT_TRUE(t.step.finish(*s, t.now, t.next)) << i;
      EXPECT_LE(t.next.v.norm(), 1e-9) << i;  // 1e6 N: round-off 1e-10 m/s^2
    }
}

// A row at the small angle theta, whose round-off is +d or -d by turns: y never settles. Its first increment is
// d/theta, which adds k d/theta to the force along x; the others are 2 d/theta. All lengths are 10, of which x = 8
// moves by 1 in the step.
bool ends_where_a_row_is_at_round_off(double k, double d) {
  constexpr double theta_of_row = 1e-6;
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(8, 0), .v = Eigen::Vector2d(1, 0)};
  springs.force = [k](const Vec& q) { return Eigen::Vector2d(k * q[1], 0); };
  springs.rows = [&](const Vec& q, const Vec&) {
    d = -d;
    return Problem::Rows{Vec::Constant(1, theta_of_row * q[1] + d), Vec::Zero(1), Vec::Zero(1),
                         Eigen::RowVector2d(0, theta_of_row)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin();
  t.iterate();
  return t.step.newton.converged();
}

// In the second iteration the force that is left moves x by c_v^2 k d/theta, which is k/8 of the increment of y.
TEST(NewmarkStep, EndsWhereForcesMoveLessThanAHundredthOfWhatTheRoundOffOfRowsMoves) {
  EXPECT_TRUE(ends_where_a_row_is_at_round_off(0.076, 15 * eps));
  EXPECT_FALSE(ends_where_a_row_is_at_round_off(0.088, 15 * eps));
}

TEST(NewmarkStep, TakesFourRoundOffsOfAllLengthsForThatOfRows) {
  EXPECT_TRUE(ends_where_a_row_is_at_round_off(0.01, 19 * eps));  // g is 2 d
  EXPECT_FALSE(ends_where_a_row_is_at_round_off(0.01, 22 * eps));
}

TEST(NewmarkStep, RejectsAPlaceBeyondAllNumbers) {
  Springs free = one_spring(0, 0, 1e308);
  free.force = [](const Vec&) { return Vec::Zero(1); };
  const auto s = free.system();
  Trapezoidal t(*s, free.start(*s), 10);
  t.begin();
  t.iterate();
  EXPECT_TRUE(t.step.newton.converged());
  EXPECT_FALSE(t.step.finish(*s, t.now, t.next));
}

// The rule's own equations, to the last bit: the increment that ended the iteration is in all of them.
TEST(NewmarkStep, EndsWhereItsAccelerationLeads) {
  Springs springs = one_spring(4, 1, 1);
  springs.theta = theta;
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.step.newton.max_iterations = 100;
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_EQ(t.next.q[0], t.now.q[0] + (t.step.dq[0] + t.c_q * t.next.a[0]));
  EXPECT_EQ(t.next.v[0], t.step.v[0] + t.c_v * t.next.a[0]);
}

// A force of 1000 N from half of the way on: what it moves counts as a length, too, also beside much longer ones.
TEST(NewmarkStep, EndsAtItsToleranceOfAnAccelerationThatBeginsWithinTheStep) {
  for (const double far : {0.0, 1e6}) {
    Springs springs{
        .k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0, far), .v = Eigen::Vector2d(1, far)};
    springs.force = [](const Vec& q) { return Eigen::Vector2d(q[0] > 0.5 ? 1000 : 0, 0); };
    springs.theta = theta;
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1);
    t.step.newton.max_iterations = 100;
    t.begin();
    t.iterate();
    const double length = 2 + t.c_q * 1000, speeds = std::max(2.0, 2 * far) + t.c_v * 1000;
    expect_just_below(
        {std::abs(t.next.a[0] - 1000), 1e-11 * std::min(length / t.c_q, speeds / t.c_v), springs.factorisations},
        theta);
  }
}

}  // namespace
}  // namespace trammel::test
