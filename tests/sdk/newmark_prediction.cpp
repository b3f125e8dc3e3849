// Where a step's iteration begins.
#include <gtest/gtest.h>

#include <cmath>

#include "trapezoidal_step.hpp"

namespace trammel::test {
namespace {

TEST(NewmarkStep, PredictsAccelerationsByALineAndMultipliersByTheirLastValue) {
  const Springs springs = one_spring(1, 1, 0);
  const auto s = springs.system();
  State now = springs.start(*s);
  now.a[0] = 1.25;
  Trapezoidal t(*s, now, 0.1);
  t.begin({Vec::Constant(1, 1), 2});
  EXPECT_EQ(t.next.a[0], 1.75);
  EXPECT_EQ(t.next.t, 0.1);

  Springs rod = springs;
  rod.rows = [](const Vec& q, const Vec&) { return Problem::Rows{q, Vec::Zero(1), Vec::Zero(1), Mat::Ones(1, 1)}; };
  rod.force = [](const Vec&) { return Vec::Constant(1, 3); };
  const auto held = rod.system();
  Trapezoidal u(*held, rod.start(*held), 0.1);
  u.begin();
  EXPECT_EQ(u.next.lambda, u.now.lambda);
  EXPECT_NEAR(u.now.lambda[0], 3, 8 * eps);
}

TEST(NewmarkStep, KeepsTheAccelerationThatChangesByHalfOrWasThatOfAMuchShorterStep) {
  const Springs springs = one_spring(1, 1, 0);
  const auto s = springs.system();
  State now = springs.start(*s);
  now.a[0] = 1;
  Trapezoidal t(*s, now, 0.1);
  const auto predicted = [&](double before, double ratio) {
    t.begin({Vec::Constant(1, before), ratio});
    return t.next.a[0];
  };
  EXPECT_NEAR(predicted(0.51, 1), 1.49, 4 * eps);
  EXPECT_EQ(predicted(0.49, 1), 1);
  EXPECT_EQ(predicted(1.51, 1), 1);
  EXPECT_NEAR(predicted(0.9, 3.9), 1.39, 4 * eps);
  EXPECT_EQ(predicted(0.9, 4.1), 1);
  t.begin();
  EXPECT_EQ(t.next.a[0], 1) << "without a step before";
}

// omega h = 1000: a_n moves q by 250 times its amplitude. Without it the first guess is the place that v leads to.
TEST(NewmarkStep, BeginsAlongTheVelocityWhereAccelerationsLeadAstray) {
  const double h = 1;
  for (const bool line : {false, true}) {
    const Springs springs = one_spring(1e6, 1e-3, 0.1);
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), h);
    t.begin(line ? Previous{0.9 * t.now.a, 1} : Previous{});
    t.correct();
    EXPECT_EQ(springs.factorisations, 0) << "nothing is solved for yet";
    t.residual();
    EXPECT_NEAR(t.next.q[0], 1e-3 + h * 0.1, 1e-12);  // round-off of 250 m of a_n
    t.correct();
    EXPECT_NEAR(t.next.a[0], t.exact(springs)[0], 1e-9 * std::abs(t.now.a[0]));
  }
}

// Each is half of what makes an acceleration misleading: it moves q further than v does, and changes forces by more
// than M a.
TEST(NewmarkStep, BeginsWithTheAccelerationWhereItMovesLittleOrChangesForcesLittle) {
  const auto first_solves = [](const Springs& springs) {
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1);
    t.begin();
    t.correct();
    return springs.factorisations == 1 && std::abs(t.next.a[0] - t.exact(springs)[0]) <= 1e-9 * std::abs(t.now.a[0]);
  };
  EXPECT_TRUE(first_solves(one_spring(1e6, 1e-3, 1e5))) << "v moves q by 1e5 m, a by 500 m";
  EXPECT_TRUE(first_solves(one_spring(1e6, 1e-3, 501))) << "both by about 500 m";
  EXPECT_FALSE(first_solves(one_spring(1e6, 1e-3, 499)));
  EXPECT_TRUE(first_solves(one_spring(0.1, 1, 0))) << "a slow motion from rest";
  EXPECT_TRUE(first_solves(one_spring(3.9, 1, 0))) << "c_q k < 1";
  EXPECT_FALSE(first_solves(one_spring(4.1, 1, 0))) << "c_q k > 1";
  EXPECT_FALSE(first_solves(one_spring(1e6, 1e-3, 0.1)));
}

}  // namespace
}  // namespace trammel::test
