// Error estimates shrink with the order claimed and are near the true local error (trammel/testing/measurements.hpp
// says how near);
// dense output has its order.
#include "support.hpp"

namespace trammel::test {
namespace {

struct Estimated {
  Form form;
  double h;  // of the largest step
};
class ErrorEstimated : public testing::TestWithParam<Estimated> {};

TEST_P(ErrorEstimated, ShrinksWithItsOrder) {
  double claimed = 0;  // of the last trial: Adams' own differs from that of its starter
  const Order f = fit_order(1, 4, [&](int n) {
    Posed s(problems::pendulum_with_rod());
    auto method = make(GetParam().form.name, GetParam().form.settings);
    auto& estimate = dynamic_cast<ErrorEstimate&>(*method);
    const double h = GetParam().h / n;
    const State start = s.start();
    method->restart(s, start);
    const State now = advance(*method, s, start, h, 5 * n);  // to the same time; a history is filled
    State next;
    if (!method->step(s, now, h, next)) throw std::runtime_error("rejected");
    claimed = estimate.error_order();
    return estimate.error(s, now, next, {.relative = 0, .absolute = 1});
  });
  EXPECT_NEAR(f.value, claimed, 0.35) << f.table;
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, ErrorEstimated,
    testing::Values(Estimated{{"hht_alpha", {{"alpha", -0.1}}}, 0.02}, Estimated{{"hht_alpha", {{"alpha", 0.0}}}, 0.02},
                    Estimated{{"newmark", {}}, 0.02}, Estimated{{"newmark", {{"beta", 0.3025}, {"gamma", 0.6}}}, 0.02},
                    Estimated{{"generalized_alpha", {{"rho_inf", 0.8}}}, 0.02},
                    Estimated{{"adams_baumgarte", {{"epsilon", 10.0}}}, 0.01},
                    Estimated{{"adams_baumgarte", {{"predictor", std::string("ab3")}, {"epsilon", 10.0}}}, 0.01},
                    Estimated{{"runge_kutta_4", {}}, 0.04}, Estimated{{"dormand_prince", {}}, 0.04},
                    Estimated{{"dop853", {}}, 0.16},
                    Estimated{{"exponential_collocation", {{"delta", 1.0}, {"epsilon", 1.0}}}, 0.08}),
    [](const testing::TestParamInfo<Estimated>& tested) {
      return tested.param.form.name + "_" + std::to_string(tested.index);
    });

// In every form, on motions whose error is that of the positions (slow) or that of the velocities (fast), and on rows.
class EveryEstimate : public testing::TestWithParam<Form> {
 protected:
  void expect(const Problem& problem, double omega) {
    const Maker maker = [] { return make(GetParam().name, GetParam().settings); };
    const int order = maker()->traits().order;
    // Long enough for errors above round-off, short enough for the next term to be a few hundredths.
    const double step = order <= 2 ? 0.02 : order == 4 ? 0.04 : order == 5 ? 0.06 : 0.2;
    const Report report = check_estimate(maker, problem, omega, step / omega);
    EXPECT_TRUE(report) << report.table;
  }
  static constexpr double pendulum_omega = 3.132;
};
TEST_P(EveryEstimate, IsNearTheErrorOfASlowOscillator) {
  expect(problems::oscillator(0.2, 0.1), 0.2);
}
TEST_P(EveryEstimate, IsNearTheErrorOfAFastOscillator) {
  expect(problems::oscillator(20, 0.1), 20);
}
TEST_P(EveryEstimate, IsNearTheErrorOfThePendulum) {
  expect(problems::pendulum(), pendulum_omega);
}
TEST_P(EveryEstimate, IsNearTheErrorWhereTheMassVaries) {
  expect(problems::pendulum_of_varying_mass(), pendulum_omega);
}
TEST_P(EveryEstimate, IsNearTheErrorOnRows) {
  if (GetParam().name == "exponential_collocation" && GetParam().settings.empty())
    GTEST_SKIP() << "its sweeps do not converge with the default terms of Baumgarte at this step, and it says so";
  expect(problems::pendulum_with_rod(), pendulum_omega);
}
INSTANTIATE_TEST_SUITE_P(All, EveryEstimate, testing::ValuesIn(all_forms()),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

// Newmark's own accelerations are those of the motion, so that what it remembers serves whatever the steps were. From a
// step of h/2 to one of h: the leading term of the error is that of h alone; the next one, of relative size omega h =
// 0.02, is not counted.
TEST(NewmarkError, IsTheTrueErrorWhereStepsChange) {
  for (const double omega : {0.2, 20.0}) {
    Posed s(problems::oscillator(omega));
    auto method = make("newmark");
    auto& estimate = dynamic_cast<ErrorEstimate&>(*method);
    const double h = 0.02 / omega;
    State next;
    const State start = s.exact(0.7 / omega);
    method->restart(s, start);
    const State now = advance(*method, s, start, h / 2, 4);
    ASSERT_TRUE(method->step(s, now, h, next));
    const double estimated = estimate.error(s, now, next, {.relative = 0, .absolute = 1});
    auto fine = make("dop853");
    const State exact = integrate(*fine, s, now, now.t + h, 1);  // of an error of (omega h)^9
    const double error = std::sqrt(((next.q - exact.q).squaredNorm() + (next.v - exact.v).squaredNorm()) / 2);
    EXPECT_NEAR(estimated / error, 1, 0.05) << omega;
  }
}

TEST(NewmarkError, AlsoMeasuresTheFirstStepAfterARestart) {
  Posed s(oscillators({2}));
  auto method = make("newmark");
  auto& estimate = dynamic_cast<ErrorEstimate&>(*method);
  const State start = s.start();
  State next;
  const double h = 1e-2;
  method->restart(s, start);
  ASSERT_TRUE(method->step(s, start, h, next));
  const double estimated = estimate.error(s, start, next, {.relative = 0, .absolute = 1});
  // From rest at q = 1: e_v = h^3/12 v''' = h^3/12 omega^4 q, e_q is of the next order; over two components.
  EXPECT_NEAR(estimated / (h * h * h / 12 * 16 / std::sqrt(2.0)), 1,
              0.02);  // next term: (omega h)^2 and the difference's h/1000
}

// One motion of 1 rad/s and 1 m, one of omega and d, after a few steps.
double error_of_two(const std::string& name, double omega, double d, double h, const Tolerance& tolerance) {
  Posed s(oscillators({1, omega}));
  auto method = make(name);
  State start = s.start();
  start.q[1] = d;
  s->move_to(start.t, start.q, start.v);
  s->accelerate({}, start.a, start.lambda);
  method->restart(s, start);
  const State now = advance(*method, s, start, h, 5);
  State next;
  if (!method->step(s, now, h, next)) throw std::runtime_error("rejected");
  return dynamic_cast<ErrorEstimate&>(*method).error(s, now, next, tolerance);
}

// What is too fast for the step counts by what it moves, omega d h a step, not by its accelerations omega^2 d.
TEST(NewmarkError, IsThatOfTheSlowMotionBesideAFastOne) {
  const Tolerance tight{.relative = 0, .absolute = 1e-9};
  const double h = 0.1, omega = 1e6;
  for (const char* name : {"hht_alpha", "generalized_alpha", "newmark"}) {
    const double slow = error_of_two(name, omega, 0, h, tight);
    EXPECT_GT(slow, 1) << name;
    // Accelerations of 1e-2 m/s^2, beside 1e-4 of the error of the slow ones; the rest is (omega h)^2 of the filter.
    EXPECT_NEAR(error_of_two(name, omega, 1e-14, h, tight) / slow, 1, 0.01) << name;
    EXPECT_GT(error_of_two(name, omega, 1e-7, h, tight), 5 * slow) << name;
  }
}

struct Dense {
  std::string name;
  int order, n;
};
class DenseOutputOf : public testing::TestWithParam<Dense> {};

TEST_P(DenseOutputOf, HasItsOrderInsideTheStep) {
  Posed s(oscillators({1, 2}, 0.1));
  const Order f = fit_order(GetParam().n, 4, [&](int n) {
    auto method = make(GetParam().name);
    auto& dense = dynamic_cast<DenseOutput&>(*method);
    State now = s.start(), next, at;
    method->restart(s, now);
    const double h = 2.0 / n;
    double error = 0;
    for (int i = 0; i < n; ++i) {
      if (!method->step(s, now, h, next)) throw std::runtime_error("rejected");
      for (const double theta : {0.2, 0.5, 0.7}) {
        dense.interpolate(s, now, next, theta, at);
        const State exact = s.exact(at.t);
        error = std::max(error, (at.q - exact.q).norm() + (at.v - exact.v).norm());
      }
      method->accept(s, now, next);
      std::swap(now, next);
    }
    return error;
  });
  // Locally of one order more; summed up over the run the method's own error, of one order more as well, may mix in.
  EXPECT_GE(f.value, GetParam().order + 0.7) << f.table;
  EXPECT_LE(f.value, GetParam().order + 1.3) << f.table;
}

TEST_P(DenseOutputOf, MeetsTheStepAtItsEnds) {
  Posed s(problems::pendulum_with_rod());
  auto method = make(GetParam().name);
  auto& dense = dynamic_cast<DenseOutput&>(*method);
  const State now = s.start();
  State next, at;
  method->restart(s, now);
  ASSERT_TRUE(method->step(s, now, 0.05, next));
  dense.interpolate(s, now, next, 0, at);
  EXPECT_TRUE(same_bits(at.q, now.q) && same_bits(at.v, now.v));
  dense.interpolate(s, now, next, 1, at);
  EXPECT_LE((at.q - next.q).norm() + (at.v - next.v).norm(), 2e-15);  // one rounding of a sum
  EXPECT_NEAR(at.t, next.t, 1e-16);
}

TEST_P(DenseOutputOf, LooksIntoTheStepItIsGivenAfterOtherTrials) {
  Posed s(problems::pendulum_with_rod());
  auto method = make(GetParam().name);
  auto& dense = dynamic_cast<DenseOutput&>(*method);
  const State now = s.start();
  State next, other, before, after;
  method->restart(s, now);
  ASSERT_TRUE(method->step(s, now, 0.05, next));
  dense.interpolate(s, now, next, 0.4, before);
  ASSERT_TRUE(method->step(s, now, 0.01, other));
  method->accept(s, now, next);
  dense.interpolate(s, now, next, 0.4, after);
  EXPECT_TRUE(same_bits(before.q, after.q) && same_bits(before.v, after.v));
}

TEST_P(DenseOutputOf, StaysOnTheManifold) {
  Posed s(problems::heavy_top());
  auto method = make(GetParam().name);
  auto& dense = dynamic_cast<DenseOutput&>(*method);
  const State now = s.start();
  State next, at;
  method->restart(s, now);
  ASSERT_TRUE(method->step(s, now, 0.02, next));
  for (const double theta : {0.2, 0.5, 0.9}) {
    dense.interpolate(s, now, next, theta, at);
    EXPECT_NEAR(at.q.norm(), 1, 1e-15);
  }
}

TEST_P(DenseOutputOf, TellsStepsApartWhoseAccelerationsAgree) {
  Posed s(oscillators({0}));  // no force: every step ends with the same acceleration
  auto method = make(GetParam().name);
  auto& dense = dynamic_cast<DenseOutput&>(*method);
  State now = s.start(), next, other, at;
  now.v.setOnes();
  method->restart(s, now);
  ASSERT_TRUE(method->step(s, now, 0.05, next));
  ASSERT_TRUE(method->step(s, now, 0.01, other));
  dense.interpolate(s, now, next, 0.4, at);
  EXPECT_NEAR(at.t, now.t + 0.02, 1e-16);
  EXPECT_LE((at.q - now.q - 0.02 * now.v).norm(), 1e-15);  // uniform motion, to roundings of numbers near 1
}

INSTANTIATE_TEST_SUITE_P(Integrators, DenseOutputOf,
                         testing::Values(Dense{"dormand_prince", 4, 20}, Dense{"dop853", 7, 4},
                                         Dense{"exponential_collocation", 7, 1}),
                         [](const testing::TestParamInfo<Dense>& tested) { return tested.param.name; });

}  // namespace
}  // namespace trammel::test
