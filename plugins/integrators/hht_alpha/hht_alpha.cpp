// The method of Hilber, Hughes and Taylor for constrained mechanical systems: the alpha method
// (methods/alpha_method.hpp) with
//
//     alpha_m = 0,   alpha_f = -alpha,   gamma = 1/2 - alpha,   beta = (1 - alpha)^2 / 4,   alpha in [-1/3, 0]
//
// Some texts write alpha for our -alpha. For constant M this is the original form
//     1/(1+alpha) M a_{n+1} - (f - W^T lambda)_{n+1} + alpha/(1+alpha) (f - W^T lambda)_n = 0
// Negrut, Rampalli, Ottarsson, Sajdak, J. Comput. Nonlinear Dynam. 2(1), 73-85 (2007); Jay, Negrut, ETNA 26, 190-208
// (2007).
#include <trammel/methods/alpha_method.hpp>
#include <trammel/methods/newmark_parameters.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class HhtAlpha final : public Integrator, public ErrorEstimate {
 public:
  double alpha = -0.1;
  Formulation formulation = Formulation::stabilised;
  double tolerance = Newton().tolerance;
  int max_iterations = Newton().max_iterations;

  void prepare(const World&) override {
    method_.set({.alpha_m = 0, .alpha_f = -alpha, .beta = (1 - alpha) * (1 - alpha) / 4, .gamma = 0.5 - alpha},
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
    trammel::integrator<HhtAlpha>("hht_alpha", "HHT-alpha: second order, damps the modes too fast for the step")
        .source("Negrut et al. 2007, J. Comput. Nonlinear Dynam. 2(1), 73-85; Jay, Negrut 2007, ETNA 26, 190-208")
        .parameter("alpha", &HhtAlpha::alpha,
                   {.min = -1.0 / 3, .max = 0, .doc = "numerical damping; 0 is the trapezoidal rule without any"})))
