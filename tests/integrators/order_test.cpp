// Orders of convergence, from both sides. Orders are fitted over four halvings in the asymptotic range; the second-order
// methods' next term is of relative size h, hence the tolerance 0.1.
#include "support.hpp"
#include "systems.hpp"

namespace trammel::test {
namespace {

// A reference by dop853 at steps where the error is round-off, in the coordinates of the system itself.
State reference(System& s, const State& start, double until) {
  auto method = make("dop853", {{"delta", 0.0}, {"epsilon", 0.0}});
  return run(*method, s, start, until, 400);
}

struct Orders {
  Fit q, v, lambda;
};
Orders pendulum_orders(const std::string& name, const Settings& settings, double wind = 0) {
  Pendulum s;
  s.wind = wind;
  const State start = s.start(), end = reference(s, start, 1);
  const auto error = [&](auto part) {
    return fit(100, 5, [&](int n) {
      auto method = make(name, settings);
      return part(run(*method, s, start, 1, n));
    });
  };
  return {error([&](const State& x) { return (x.q - end.q).norm(); }),
          error([&](const State& x) { return (x.v - end.v).norm(); }),
          error([&](const State& x) { return (x.lambda - end.lambda).norm(); })};
}

class SecondOrder : public testing::TestWithParam<Form> {};

TEST_P(SecondOrder, InPositionsVelocitiesAndMultipliersOnThePendulumInRedundantCoordinates) {
  const Orders o = pendulum_orders(GetParam().name, GetParam().settings);
  EXPECT_NEAR(o.q.order, 2, 0.1) << o.q.table;
  EXPECT_NEAR(o.v.order, 2, 0.1) << o.v.table;
  EXPECT_NEAR(o.lambda.order, 2, 0.1) << o.lambda.table;
}

TEST_P(SecondOrder, AlsoWhereTheRowsDependOnTime) {
  const Orders o = pendulum_orders(GetParam().name, GetParam().settings, 0.2);
  EXPECT_NEAR(o.q.order, 2, 0.1) << o.q.table;
  EXPECT_NEAR(o.v.order, 2, 0.1) << o.v.table;
}

TEST_P(SecondOrder, OnTheQuaternionTop) {
  Top s;
  const State start = s.start(), end = reference(s, start, 0.5);
  const Fit f = fit(200, 5, [&](int n) {
    auto method = make(GetParam().name, GetParam().settings);
    Vec e;
    s.difference(run(*method, s, start, 0.5, n).q, end.q, e);
    return e.norm();
  });
  EXPECT_NEAR(f.order, 2, 0.1) << f.table;
}

std::string form_name(const testing::TestParamInfo<Form>& info) {
  return info.param.name + "_" + std::to_string(info.index);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, SecondOrder,
    testing::Values(Form{"hht_alpha", {{"alpha", -0.3}}},
                    Form{"hht_alpha", {{"alpha", -0.3}, {"formulation", std::string("index3")}}},
                    Form{"hht_alpha", {{"alpha", -0.15}}}, Form{"hht_alpha", {{"alpha", 0.0}}},
                    Form{"hht_alpha", {{"alpha", -1.0 / 3}}}, Form{"newmark", {}},
                    Form{"generalized_alpha", {{"rho_inf", 0.9}}},
                    Form{"generalized_alpha", {{"rho_inf", 0.9}, {"formulation", std::string("index3")}}},
                    Form{"generalized_alpha", {{"rho_inf", 0.5}}},
                    Form{"generalized_alpha", {{"rho_inf", 0.5}, {"formulation", std::string("index3")}}}),
    form_name);

TEST(Newmark, IsOfFirstOrderForGammaAboveOneHalf) {
  const Orders o = pendulum_orders("newmark", {{"beta", 0.3025}, {"gamma", 0.6}});
  EXPECT_NEAR(o.q.order, 1, 0.1) << o.q.table;
  EXPECT_NEAR(o.v.order, 1, 0.1) << o.v.table;
  EXPECT_NEAR(o.lambda.order, 1, 0.1) << o.lambda.table;
}

struct Explicit {
  Form form;
  int order, n_oscillator, n_pendulum, n_top;
};
class ExplicitOrder : public testing::TestWithParam<Explicit> {};

TEST_P(ExplicitOrder, OnTheDampedOscillator) {
  Oscillators s({2, 3}, 0.4);
  const State start = s.start(), end = s.exact(3);
  const Fit f = fit(GetParam().n_oscillator, 4, [&](int n) {
    auto method = make(GetParam().form.name, GetParam().form.settings);
    const State x = run(*method, s, start, 3, n);
    return (x.q - end.q).norm() + (x.v - end.v).norm();
  });
  EXPECT_NEAR(f.order, GetParam().order, 0.15) << f.table;
}

TEST_P(ExplicitOrder, OnThePendulumInRedundantCoordinates) {
  Pendulum s;
  const State start = s.start(), end = reference(s, start, 2);
  const Fit f = fit(GetParam().n_pendulum, 4, [&](int n) {
    auto method = make(GetParam().form.name, GetParam().form.settings);
    const State x = run(*method, s, start, 2, n);
    return (x.q - end.q).norm() + (x.v - end.v).norm() + (x.lambda - end.lambda).norm();
  });
  EXPECT_NEAR(f.order, GetParam().order, 0.2) << f.table;
}

TEST_P(ExplicitOrder, OnTheQuaternionTop) {
  Top s;
  const State start = s.start(), end = reference(s, start, 0.5);
  const Fit f = fit(GetParam().n_top, 4, [&](int n) {
    auto method = make(GetParam().form.name, GetParam().form.settings);
    Vec e;
    s.difference(run(*method, s, start, 0.5, n).q, end.q, e);
    return e.norm();
  });
  EXPECT_NEAR(f.order, GetParam().order, 0.2) << f.table;
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, ExplicitOrder,
    testing::Values(Explicit{{"runge_kutta_4", {}}, 4, 20, 40, 40},
                    Explicit{{"adams_baumgarte", {{"epsilon", 10.0}}}, 4, 160, 320, 160},
                    Explicit{{"adams_baumgarte", {{"predictor", std::string("ab3")}}}, 4, 80, 160, 160},
                    Explicit{{"dormand_prince", {}}, 5, 96, 160, 20}, Explicit{{"dop853", {}}, 8, 6, 10, 8}),
    [](const testing::TestParamInfo<Explicit>& tested) {
      return tested.param.form.name + "_" + std::to_string(tested.index);
    });

}  // namespace
}  // namespace trammel::test
