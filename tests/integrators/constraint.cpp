// Rows of the system: held to round-off where a method promises it, kept in bounds by Baumgarte's terms elsewhere.
#include "support.hpp"

namespace trammel::test {
namespace {

class Stabilised : public testing::TestWithParam<Form> {};

TEST_P(Stabilised, HoldsPositionsAndVelocitiesToRoundOffAfterEachStep) {
  Posed s(problems::pendulum_on_swinging_pivot());
  auto method = make(GetParam().name, GetParam().settings);
  ASSERT_TRUE(method->traits().holds_position && method->traits().holds_velocity);
  for (const double h : {1e-6, 1e-4, 1e-2, 5e-2}) {
    State now = s.start(), next;
    method->restart(s, now);
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(method->step(s, now, h, next));
      method->accept(s, now, next);
      s->move_to(next.t, next.q, next.v);
      // A few roundings of numbers of size 1 (positions) and of size |v| <= 10.
      ASSERT_LE(std::abs(s->g()[0]), 1e-15) << "h = " << h << ", step " << i;
      ASSERT_LE(std::abs(s->g_dot()[0]), 1e-14) << "h = " << h << ", step " << i;
      std::swap(now, next);
    }
  }
}

TEST_P(Stabilised, KeepsTheMultiplierFreeOfRoundOffAtSmallSteps) {
  Posed s(problems::pendulum_with_rod());
  const State start = s.start();
  auto method = make(GetParam().name, GetParam().settings);
  const State end = integrate(*method, s, start, 1e-4, 100);  // h = 1e-6
  Vec a, lambda;
  s->move_to(end.t, end.q, end.v);
  s->accelerate({}, a, lambda);
  // Velocity rows divide round-off (1e-16) by h; errors of the method are of the order h |lambda'| = 1e-5.
  EXPECT_NEAR(end.lambda[0], lambda[0], 2e-5);
}

TEST_P(Stabilised, MovesPositionsAcrossTheirRowsWhereFrictionTiltsTheReactions) {
  Posed s(sliding(0.5, 1e-3));
  const State start = s.start();
  auto method = make(GetParam().name, GetParam().settings);
  State next;
  method->restart(s, start);
  ASSERT_TRUE(method->step(s, start, 1e-2, next));
  EXPECT_LE(std::abs(next.q[1]), 1e-15);             // round-off
  EXPECT_NEAR(next.q[0], start.q[0] + 1e-2, 1e-15);  // along the reaction it would be off by 0.5e-3
}

INSTANTIATE_TEST_SUITE_P(Integrators, Stabilised,
                         testing::Values(Form{"hht_alpha", {{"alpha", -0.15}}}, Form{"hht_alpha", {{"alpha", 0.0}}},
                                         Form{"hht_alpha", {{"alpha", -1.0 / 3}}}, Form{"newmark", {}},
                                         Form{"generalized_alpha", {{"rho_inf", 0.9}}},
                                         Form{"generalized_alpha", {{"rho_inf", 0.0}}},
                                         Form{"runge_kutta_4", {{"rows", std::string("projected")}}},
                                         Form{"dop853", {{"rows", std::string("projected")}}},
                                         Form{"adams_baumgarte", {{"rows", std::string("null_space")}}},
                                         Form{"runge_kutta_4", {{"rows", std::string("null_space")}}},
                                         Form{"dormand_prince", {{"rows", std::string("null_space")}}},
                                         Form{"dop853", {{"rows", std::string("null_space")}}}),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

TEST(Index3, HoldsPositionsAndLetsVelocitiesGo) {
  for (const char* name : {"hht_alpha", "generalized_alpha", "newmark"}) {
    SCOPED_TRACE(name);
    Posed s(problems::pendulum_with_rod());
    auto method = make(name, {{"formulation", std::string("index3")}});
    EXPECT_TRUE(method->traits().holds_position);
    EXPECT_FALSE(method->traits().holds_velocity);
    EXPECT_FALSE(method->traits().friction);  // it divides round-off of the positions by the step
    const State end = integrate(*method, s, s.start(), 1, 100);
    s->move_to(end.t, end.q, end.v);
    EXPECT_LE(std::abs(s->g()[0]), 1e-15);     // round-off
    EXPECT_GE(std::abs(s->g_dot()[0]), 1e-8);  // no equation of this formulation
    const auto stabilised = make(name)->traits();
    EXPECT_TRUE(stabilised.holds_position && stabilised.holds_velocity && stabilised.friction);
  }
}

TEST(Index3, RefusesAStepWhoseRoundOffOutweighsTheVelocity) {
  Posed s(problems::pendulum_with_rod());
  auto method = make("hht_alpha", {{"formulation", std::string("index3")}});
  const State start = s.start();
  State next;
  method->restart(s, start);
  const Outcome outcome = method->step(s, start, 1e-14, next);
  EXPECT_FALSE(outcome);
  EXPECT_NE(std::string(outcome.reason()).find("index3"), std::string::npos);
}

TEST(Baumgarte, DecaysViolationsThatStayWithoutIt) {
  for (const char* name : {"adams_baumgarte", "runge_kutta_4", "dormand_prince", "dop853", "exponential_collocation"}) {
    const auto violation = [&](double delta, double epsilon) {
      Posed s(problems::pendulum_with_rod());
      auto method = make(name, {{"delta", delta}, {"epsilon", epsilon}});
      State now = s.start();
      now.q *= 1.0001;  // g = 1e-4, G v = 0
      method->restart(s, now);
      const State end = advance(*method, s, now, 1e-3, 1000);
      s->move_to(end.t, end.q, end.v);
      return s->g()[0];
    };
    // g'' = 0 keeps g = 1.00005e-4; g'' + 20 g' + 100 g = 0 leaves exp(-10) (1 + 10) of it. The methods' errors: 1e-9.
    EXPECT_NEAR(violation(0, 0), 1.00005e-4, 1e-9) << name;
    EXPECT_NEAR(violation(10, 10), 1.00005e-4 * 11 * std::exp(-10), 1e-9) << name;
  }
}

TEST(Newmark, RefusesBetaZeroWithIndex3ByName) {
  try {
    make("newmark", {{"beta", 0.0}, {"formulation", std::string("index3")}});
    FAIL() << "accepted";
  } catch (const ParameterError& e) {
    EXPECT_EQ(e.parameter(), "beta");
  }
}

}  // namespace
}  // namespace trammel::test
