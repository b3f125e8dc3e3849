// How a step puts its end onto the rows.
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "trapezoidal_step.hpp"

namespace trammel::test {
namespace {

// A particle at (0, y), at rest, on the rows y = 0 as they are given.
struct OnRows {
  Springs springs;
  int evaluations = 0;
  explicit OnRows(double x, double y, std::function<Problem::Rows(const Vec& q)> of) {
    springs = {.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(x, y), .v = Vec::Zero(2)};
    springs.force = [](const Vec&) { return Vec::Zero(2); };
    springs.rows = [this, of](const Vec& q, const Vec&) { return ++evaluations, of(q); };
  }
  // What `finish` returns, and how often it evaluates rows.
  std::pair<Outcome, int> finish() {
    const auto s = springs.system();
    State now = springs.start(*s);
    now.a.setZero(), now.lambda.setZero();
    Trapezoidal t(*s, now, 1);
    t.begin();
    t.iterate();
    evaluations = 0;
    const Outcome outcome = t.step.finish(*s, t.now, t.next);
    return {outcome, evaluations};
  }
};
Problem::Rows plane(double y, double slope = 1) {
  return {Vec::Constant(1, y), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, slope)};
}

TEST(NewmarkStep, EvaluatesRowsOnceMoreWhereItsIterationHasSatisfiedThem) {
  EXPECT_EQ(OnRows(0, 1e-3, [](const Vec& q) { return plane(q[1]); }).finish().second, 1);
}

// Factors are as wrong as q has moved since: 1e-12 of what the iteration left, 1e-13, is below round-off.
TEST(NewmarkStep, EvaluatesRowsOnceMoreAfterATinyMotion) {
  EXPECT_EQ(OnRows(1, 1e-12, [](const Vec& q) { return plane(q[1], 1 / 0.9); }).finish().second, 1);
}

TEST(NewmarkStep, GoesOnWhileFactorsOfAnEarlierPointLeaveMoreThanRoundOff) {
  OnRows wrong(1, 1e-2, [](const Vec& q) { return plane(q[1], 1 / 0.9); });
  EXPECT_GE(wrong.finish().second, 2);
}

// y = 0 and y = apart: half of `apart` is left in each.
TEST(NewmarkStep, RejectsRowsThatContradictEachOtherByAMillionthOfTheLengths) {
  for (const double x : {1.0, 1000.0}) {
    const auto contradicting = [&](double apart) {
      return OnRows(x, 0,
                    [apart](const Vec& q) {
                      return Problem::Rows{Eigen::Vector2d(q[1], q[1] - apart), Vec::Zero(2), Vec::Zero(2),
                                           Mat{{0, 1}, {0, 1}}};
                    })
          .finish()
          .first;
    };
    EXPECT_TRUE(contradicting(1.9e-6 * x));
    EXPECT_FALSE(contradicting(2.1e-6 * x));
  }
}

TEST(NewmarkStep, AcceptsSatisfiedRowsThatMoveNothing) {
  Springs nothing{.k = Vec(0), .rest = Vec(0), .q = Vec(0), .v = Vec(0)};
  double off = 0;
  nothing.rows = [&](const Vec&, const Vec&) {
    return Problem::Rows{Vec::Constant(1, off), Vec::Zero(1), Vec::Zero(1), Mat(1, 0)};
  };
  const auto s = nothing.system();
  Trapezoidal t(*s, State{0, Vec(0), Vec(0), Vec(0), Vec::Zero(1)}, 1);
  t.begin();
  EXPECT_TRUE(t.step.finish(*s, t.now, t.next));
  off = 1e-3;
  EXPECT_FALSE(t.step.finish(*s, t.now, t.next));
}

// A motion about the origin. One increment leaves its velocity off the row, which `finish` corrects by reactions.
TEST(NewmarkStep, KeepsTheBalanceOfForcesWhereItCorrectsRowsAlone) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(1, 0), .v = Eigen::Vector2d(0, 1)};
  springs.rows = [](const Vec& q, const Vec& v) {
    return Problem::Rows{Vec::Constant(1, (q.squaredNorm() - 1) / 2), Vec::Zero(1), Vec::Constant(1, -v.squaredNorm()),
                         q.transpose()};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 0.1);
  t.step.newton.tolerance = 0.1;
  t.begin();
  EXPECT_EQ(t.iterate(), 1);
  const double left = t.residual().norm();
  const Vec a = t.next.a;
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_GE((t.next.a - a).norm(), 10 * left);
  EXPECT_LE(t.residual().norm(), 2 * left);
}

// First along a plane with friction, whose reactions are tilted, then along a wall without: positions are brought onto
// the wall across it.
TEST(NewmarkStep, ForgetsTheFactorsOfRowsThatHadFriction) {
  bool wall = false;
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(1e-3, 1e-3), .v = Vec::Zero(2)};
  springs.rows = [&](const Vec& q, const Vec&) {
    Problem::Rows rows = plane(q[1]);
    if (wall)
      rows.g = q.head(1), rows.G = Eigen::RowVector2d(1, 0);
    else
      rows.W = Eigen::RowVector2d(-0.5, 1);
    return rows;
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 0.1);
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_NEAR(t.next.q[1], 0, 1e-16);
  wall = true;
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_NEAR(t.next.q[0], 0, 1e-16);
  EXPECT_NEAR(t.next.q[1], 1e-3, 1e-16);
}

}  // namespace
}  // namespace trammel::test
