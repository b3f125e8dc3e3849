// An explicit Runge-Kutta method (trammel/methods/runge_kutta.hpp) as an integrator. Its author writes the
// coefficients:
//
//     struct Heun {
//       static constexpr Tableau tableau{2, c, a, b};
//       static constexpr int order = 2, error_order = 2;      // of the result; the estimate shrinks with h^error_order
//       static constexpr Stabilisation baumgarte{10, 10};     // unless the scene says otherwise
//
//       // norm(weights) of h sum_i weights_i k_i over the first slopes, those of the stages and of the step's end
//       template <class Norm>
//       static double error(Norm&& norm) { return norm(less_embedded); }
//
//       // Where there is dense output: the state at theta in [0, 1]; false: a slope that it needs does not exist.
//       static bool interpolate(RungeKutta&, System&, const State& now, const State& next, double theta, State& at);
//     };
//     TRAMMEL_PLUGIN(trammel::runge_kutta_integrator<Heun>("heun", "...").source("..."))
#pragma once

#include <type_traits>

#include <trammel/linear_theory.hpp>
#include <trammel/methods/linear_roots.hpp>
#include <trammel/methods/runge_kutta.hpp>
#include <trammel/row_parameters.hpp>

namespace trammel {

namespace detail {

template <class Method>
concept Interpolated = requires {
  &Method::interpolate;
};
struct NotInterpolated {
  virtual void interpolate(System&, const State&, const State&, double, State&) {}  // no ability: never called

 protected:
  ~NotInterpolated() = default;
};

}  // namespace detail

template <class Method>
class RungeKuttaIntegrator final
    : public Integrator,
      public ErrorEstimate,
      public LinearTheory,
      public std::conditional_t<detail::Interpolated<Method>, DenseOutput, detail::NotInterpolated> {
 public:
  double delta = Method::baumgarte.alpha, epsilon = Method::baumgarte.beta;
  RungeKutta::Rows rows = RungeKutta::Rows::baumgarte;

  void prepare(const World&) override { method_.baumgarte = {delta, epsilon}, method_.rows = rows; }
  Traits traits() const override {
    return {.order = Method::order, .holds_position = method_.projects(), .holds_velocity = method_.projects()};
  }

  void restart(System& s, const State& now) override { method_.begin(s, now, slope_); }

  Outcome step(System& s, const State& now, double h, State& next) override {
    return method_.step(s, now, slope_, h, next);
  }

  // The slope at the step's end is the first one of the next.
  void accept(System& s, const State& /*now*/, const State& next) override {
    s.rate(next.q, next.v, slope_.q);
    slope_.v = next.a;
    slope_.lambda = next.lambda;
  }

  double error(System& s, const State& now, const State& next, const Tolerance& tolerance) override {
    return method_.error(now, next, [&](RungeKutta::Part part) {
      return Method::error([&]<int n>(const double(&weights)[n]) {
        method_.combine(weights, n, e_, e_v_);
        return method_.norm(s, now, next, e_, e_v_, part, tolerance);
      });
    });
  }
  int error_order() const override { return Method::error_order; }

  void interpolate(System& s, const State& now, const State& next, double theta, State& at) override {
    if constexpr (detail::Interpolated<Method>)
      if (!method_.recall(s, now, next) || !Method::interpolate(method_, s, now, next, theta, at))
        method_.step_inside(s, now, next, theta, at);
  }

  Roots roots(double Omega, double zeta) const override { return runge_kutta_roots(Method::tableau, Omega, zeta); }

  void archive(Archive& archive) override {
    method_.archive(archive);
    archive("now_slope_q", slope_.q);
    archive("now_slope_v", slope_.v);
    archive("now_slope_lambda", slope_.lambda);
  }

 private:
  RungeKutta method_{Method::tableau};
  Slope slope_;  // at the last accepted point
  Vec e_, e_v_;
};

template <class Method>
Declare<RungeKuttaIntegrator<Method>> runge_kutta_integrator(std::string name, std::string summary) {
  return row_parameters(integrator<RungeKuttaIntegrator<Method>>(std::move(name), std::move(summary)));
}

}  // namespace trammel
