// How a step puts its end onto the rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// y = 0 and y = apart: half of `apart` is left in each. Lengths are the place and what the motion along x, of the
// constant acceleration a, adds to it in the step.
TEST(NewmarkStep, RejectsRowsThatContradictEachOtherByAMillionthOfTheLengths) {
  struct Motion {
    double x, v, a;
  };
  const double h = 0.1;
  for (const auto& [x, v, a] : {Motion{0, 0, 0}, {1, 0, 0}, {1000, 0, 0}, {0, 1e3, 0}, {0, 0, 1e4}, {1, 300, -1e4}}) {
    const double lengths = std::abs(x) + h * std::abs(v) + h * h * std::abs(a) + std::abs(h * v + h * h / 4 * a);
    const double most = std::max(1e-8, 1e-6 * lengths);
    const auto contradicting = [&](double apart) {
      Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(x, 0), .v = Eigen::Vector2d(v, 0)};
      springs.force = [a](const Vec&) { return Eigen::Vector2d(a, 0); };
      springs.rows = [apart](const Vec& q, const Vec&) {
        return Problem::Rows{Eigen::Vector2d(q[1], q[1] - apart), Vec::Zero(2), Vec::Zero(2), Mat{{0, 1}, {0, 1}}};
      };
      const auto s = springs.system();
      Trapezoidal t(*s, springs.start(*s), h);
      t.begin();
      t.iterate();
      return t.step.finish(*s, t.now, t.next);
    };
    EXPECT_TRUE(contradicting(1.9 * most)) << x << " " << v << " " << a;
    EXPECT_FALSE(contradicting(2.1 * most)) << x << " " << v << " " << a;
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
  EXPECT_NEAR(t.next.q[0], 1e-3, 1e-16) << "and onto the plane across it, whatever its friction";
  wall = true;
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_NEAR(t.next.q[0], 0, 1e-16);
  EXPECT_NEAR(t.next.q[1], 1e-3, 1e-16);
}

// A particle at the distance 1e-3 from its plane, approaching it.
struct Approaching {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0, 1e-3), .v = Eigen::Vector2d(1, 0.5)};
  explicit Approaching(double friction = 0) {
    springs.rows = [friction](const Vec& q, const Vec&) {
      Problem::Rows rows = plane(q[1]);
      if (friction != 0) rows.W = Eigen::RowVector2d(-friction, 1);
      return rows;
    };
  }
};

TEST(NewmarkStep, OfIndex3SatisfiesLinearPositionsAndNotVelocitiesByItsFirstIncrement) {
  for (const double friction : {0.0, 0.5}) {
    const Approaching approaching(friction);
    const auto s = approaching.springs.system();
    Trapezoidal t(*s, approaching.springs.start(*s), 0.1);
    t.step.formulation = Formulation::index3;
    t.begin();
    t.correct();
    EXPECT_EQ(approaching.springs.factorisations, 1) << "friction " << friction;
    t.residual();
    EXPECT_LE(std::abs(s->g()[0]), 1e-16);
    EXPECT_NEAR(s->g_dot()[0], -0.5 - 2 * 1e-3 / 0.1, 1e-15) << "the trapezoidal rule: (v + v')/2 = -y/h";
    t.iterate();
    ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
    EXPECT_NEAR(t.next.v[1], -0.5 - 2 * 1e-3 / 0.1, 1e-15);
  }
}

// eps q/h^2 of acceleration is 2 eps q/h of velocity, allowed to a thousandth of v + v' = 2 v.
TEST(NewmarkStep, OfIndex3RejectsAStepWhosePositionsDoNotResolveAThousandthOfTheVelocity) {
  for (const double v : {0.01, 1.0, 100.0}) {
    const double q = 1e6, h = 2 * eps * q / (1e-3 * 2 * v);
    const auto finish = [&](double size) {
      Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(q, 0), .v = Eigen::Vector2d(v, 0)};
      springs.rows = [](const Vec& at, const Vec&) { return plane(at[1]); };
      const auto s = springs.system();
      Trapezoidal t(*s, springs.start(*s), size);
      t.step.formulation = Formulation::index3;
      t.begin();
      t.iterate();
      return t.step.finish(*s, t.now, t.next);
    };
    EXPECT_FALSE(finish(0.95 * h)) << v;
    EXPECT_TRUE(finish(1.05 * h)) << v;
  }
}

// Rows from one step to the next: those of a contact that has opened leave nothing behind.
TEST(NewmarkStep, ForgetsRowsThatAreNoLongerThere) {
  const Approaching approaching;
  const auto held = approaching.springs.system();
  Trapezoidal t(*held, approaching.springs.start(*held), 0.1);
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*held, t.now, t.next));
  const Springs springs = {
      .k = Vec::Ones(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0, 1e-3), .v = Eigen::Vector2d(1, 0.5)};
  const auto s = springs.system();
  Trapezoidal free(*s, springs.start(*s), 0.1);
  free.step = t.step;
  free.begin();
  free.iterate();
  ASSERT_TRUE(free.step.finish(*s, free.now, free.next));
  EXPECT_NEAR((free.next.a - free.exact(springs)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace trammel::test
