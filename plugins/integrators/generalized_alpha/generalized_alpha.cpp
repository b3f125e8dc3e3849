// The generalised-alpha method for constrained mechanical systems: the alpha method (methods/alpha_method.hpp) with
//
//     alpha_m = (2 rho - 1)/(rho + 1),   alpha_f = rho/(rho + 1)
//     gamma = 1/2 + alpha_f - alpha_m,   beta = (gamma + 1/2)^2 / 4
//
// rho in [0, 1] is the spectral radius for infinitely fast modes.
// Chung, Hulbert, J. Appl. Mech. 60(2), 371-375 (1993); Arnold, Bruls, Multibody Syst. Dyn. 18, 185-202 (2007).
#include <trammel/methods/alpha_method.hpp>
#include <trammel/methods/newmark_parameters.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class GeneralizedAlpha final : public Integrator, public ErrorEstimate {
 public:
  double rho_inf = 0.9;
  Formulation formulation = Formulation::stabilised;
  double tolerance = Newton().tolerance;
  int max_iterations = Newton().max_iterations;

  void prepare(const World&) override {
    const double alpha_m = (2 * rho_inf - 1) / (rho_inf + 1), alpha_f = rho_inf / (rho_inf + 1);
    const double gamma = 0.5 + alpha_f - alpha_m;
    method_.set({.alpha_m = alpha_m, .alpha_f = alpha_f, .beta = (gamma + 0.5) * (gamma + 0.5) / 4, .gamma = gamma},
                formulation);
    method_.newmark.newton.tolerance = tolerance;
    method_.newmark.newton.max_iterations = max_iterations;
  }

  Traits traits() const override {
    return {
        .order = 2, .implicit = true, .holds_position = true, .holds_velocity = formulation == Formulation::stabilised};
  }

  void restart(System&, const State& now) override { method_.restart(now); }
  Outcome step(System& s, const State& now, double h, State& next) override { return method_.step(s, now, h, next); }
  void accept(System&, const State& /*now*/, const State& next) override { method_.accept(next); }
  double error(System& s, const State& now, const State& next, const Tolerance& t) override {
    return method_.error(s, now, next, t);
  }
  int error_order() const override { return method_.error_order(); }
  void archive(Archive& a) override { method_.archive(a); }

 private:
  AlphaMethod method_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::newmark_parameters(
    trammel::integrator<GeneralizedAlpha>("generalized_alpha",
                                          "generalised alpha: second order, damping chosen by rho_inf")
        .source(
            "Chung, Hulbert 1993, J. Appl. Mech. 60(2), 371-375; Arnold, Bruls 2007, Multibody Syst. Dyn. 18, 185-202")
        .parameter(
            "rho_inf", &GeneralizedAlpha::rho_inf,
            {.min = 0,
             .max = 1,
             .doc =
                 "spectral radius for infinitely fast modes: 1 no damping (weakly unstable with index3), 0 one step"})))
