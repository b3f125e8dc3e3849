// An alpha method (trammel/methods/alpha_method.hpp) as an integrator. Its author writes the weights, as a part with
// parameters:
//
//     struct HhtAlpha : Component {
//       double alpha = -0.1;
//       AlphaMethod::Weights weights() const { return {.alpha_m = 0, .alpha_f = -alpha, ...}; }
//     };
//     TRAMMEL_PLUGIN(trammel::alpha_integrator<HhtAlpha>(
//         trammel::part<HhtAlpha>("hht_alpha", "...").source("...").parameter("alpha", &HhtAlpha::alpha, {.max = 0})))
#pragma once

#include <trammel/linear_theory.hpp>
#include <trammel/methods/alpha_method.hpp>
#include <trammel/methods/linear_roots.hpp>
#include <trammel/methods/newmark_parameters.hpp>

namespace trammel {

template <class Method>
class AlphaIntegrator final : public Integrator, public ErrorEstimate, public LinearTheory {
 public:
  Method weighted;
  Formulation formulation = Formulation::stabilised;
  double tolerance = Newton().tolerance;
  int max_iterations = Newton().max_iterations;

  void prepare(const World&) override {
    method_.set(weighted.weights(), formulation);
    method_.newmark.newton.tolerance = tolerance;
    method_.newmark.newton.max_iterations = max_iterations;
  }

  Traits traits() const override {
    const bool stabilised = formulation == Formulation::stabilised;
    return {.order = 2,
            .implicit = true,
            .holds_position = true,
            .holds_velocity = stabilised,
            .friction = stabilised};  // index 3 divides round-off of the positions by h
  }

  void restart(System&, const State& now) override { method_.restart(now); }
  Outcome step(System& s, const State& now, double h, State& next) override { return method_.step(s, now, h, next); }
  void accept(System&, const State& /*now*/, const State& next) override { method_.accept(next); }
  double error(System& s, const State& now, const State& next, const Tolerance& t) override {
    return method_.error(s, now, next, t);
  }
  int error_order() const override { return method_.error_order(); }
  void archive(Archive& a) override { method_.archive(a); }
  Roots roots(double Omega, double zeta) const override { return alpha_roots(weighted.weights(), Omega, zeta); }

 private:
  AlphaMethod method_;
};

// Its parameters: those of `method`, then what every method of Newmark steps lets a scene choose.
template <class Method>
Declare<AlphaIntegrator<Method>> alpha_integrator(const Declaration& method) {
  return newmark_parameters(integrator<AlphaIntegrator<Method>>(method.name, method.summary)
                                .source(method.source)
                                .own_part(&AlphaIntegrator<Method>::weighted, method));
}

}  // namespace trammel
