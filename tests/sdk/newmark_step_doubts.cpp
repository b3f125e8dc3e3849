// When a step does not trust factors of an earlier point.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "trapezoidal_step.hpp"

namespace trammel::test {
namespace {

// The first factors make x a million times too stiff: it hardly moves, which looks like convergence.
TEST(NewmarkStep, FactorisesAgainWhereItsFactorsHideAForce) {
  Springs springs{
      .k = Eigen::Vector2d(1, 1), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0.02, 1), .v = Vec::Zero(2), .hides = 1e6};
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin({0.99 * t.now.a, 1});
  t.iterate();
  EXPECT_EQ(springs.factorisations, 2);
  EXPECT_LE((t.next.a - t.exact(springs)).norm(), 1e-3 * t.now.a.norm());
  EXPECT_NEAR(t.next.a[0], t.exact(springs)[0], 1e-3 * 0.02);
}

// Half of the inertia is stiffness, so factors of an earlier point are doubted after three increments.
struct Doubted {
  Springs springs = one_spring(4, 1, 1);
  std::unique_ptr<System> s = springs.system();
  Trapezoidal t{*s, springs.start(*s), 1};

  explicit Doubted(double theta = 0.05) {
    springs.theta = theta;
    t.begin({1.3 * t.now.a, 1});
    for (int i = 0; i < 3; ++i) t.correct();
    EXPECT_TRUE(t.step.iterating()) << "doubted";
  }
};

// The next residual is too small to matter.
TEST(NewmarkStep, TakesASmallResidualForAConfirmation) {
  Doubted doubted;
  Trapezoidal& t = doubted.t;
  const Vec a = t.next.a;
  t.correct();
  EXPECT_TRUE(t.step.newton.converged());
  EXPECT_EQ(t.next.a, a);
  EXPECT_EQ(doubted.springs.factorisations, 1);
}

// Of a force, M da of the increment that it causes leaves a part to stiffness, and to factors of an earlier point.
TEST(NewmarkStep, DoubtsFactorsWhereInertiaLeavesATenthOfTheForce) {
  const auto doubted = [](double part) {
    Springs springs = one_spring(0, 1, 1);
    springs.theta = 0.05;
    springs.k[0] = 4 * ((1 - springs.theta) / (1 - part) - 1);
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1);
    t.begin({1.3 * t.now.a, 1});
    for (int i = 0; i < 3; ++i) t.correct();
    return t.step.iterating();
  };
  EXPECT_TRUE(doubted(0.105));
  EXPECT_FALSE(doubted(0.095));
}

// The residual that is left is theta^3 (1 + c_q k)/(1 - theta) of M da, the first increment's momentum.
TEST(NewmarkStep, TakesAThousandthOfTheFirstIncrementForASmallResidual) {
  const auto factorisations = [](double theta) {
    Doubted doubted(theta);
    doubted.t.correct();
    return doubted.springs.factorisations;
  };
  EXPECT_EQ(factorisations(0.076), 1);  // 0.95e-3
  EXPECT_EQ(factorisations(0.079), 2);  // 1.07e-3
}

// However large the increments of the step before were.
TEST(NewmarkStep, DoubtsASmallMotionAfterALargeOne) {
  Doubted doubted;
  Trapezoidal& t = doubted.t;
  t.iterate();
  t.now.q *= 1e-3, t.now.v *= 1e-3, t.now.a *= 1e-3;
  t.begin({1.3 * t.now.a, 1});
  for (int i = 0; i < 3; ++i) t.correct();
  EXPECT_TRUE(t.step.iterating());
}

// Nor is a doubt left to the next step where a caller has given up.
TEST(NewmarkStep, BeginsWithoutTheDoubtsOfAnAbandonedStep) {
  Doubted doubted;
  Trapezoidal& t = doubted.t;
  t.begin({1.3 * t.now.a, 1});
  t.next.a = t.exact(doubted.springs) * (1 + 1e-4);
  t.correct();
  EXPECT_EQ(doubted.springs.factorisations, 2);
}

// Each increment of x changes the force on the row by a thousand times as much; multipliers take all of it.
TEST(NewmarkStep, HasNoDoubtsBecauseOfForcesThatMultipliersBalance) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Vec::Zero(2), .v = Eigen::Vector2d(1, 0)};
  springs.theta = 0.05;
  springs.force = [](const Vec& q) { return Eigen::Vector2d(0.1 + 0 * q[0], -1000 * q[0]); };
  springs.rows = [](const Vec& q, const Vec&) {
    return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin({Eigen::Vector2d(0.08, 0), 1});
  t.iterate();
  EXPECT_TRUE(t.step.newton.converged());
  EXPECT_EQ(springs.factorisations, 1);
}

}  // namespace
}  // namespace trammel::test
