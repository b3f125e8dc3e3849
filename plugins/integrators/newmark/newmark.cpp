// Newmark's method for constrained mechanical systems.
//
//     (M a + W^T lambda - f)_{n+1} = 0
//     q_{n+1} = q_n (+) (h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1}))
//     v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//
// with the rows of NewmarkStep (stabilised or index 3). Second order for gamma = 1/2, otherwise first order with
// damping; stable for every step if 2 beta >= gamma >= 1/2. Newmark, J. Eng. Mech. Div. ASCE 85(3), 67-94 (1959).
#include <trammel/linear_theory.hpp>
#include <trammel/methods/linear_roots.hpp>
#include <trammel/methods/newmark_error.hpp>
#include <trammel/methods/newmark_parameters.hpp>
#include <trammel/methods/newmark_step.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class Newmark final : public Integrator, public ErrorEstimate, public LinearTheory {
 public:
  double beta = 0.25, gamma = 0.5;
  Formulation formulation = Formulation::stabilised;
  double tolerance = Newton().tolerance;
  int max_iterations = Newton().max_iterations;

  void prepare(const World&) override {
    if (beta == 0 && formulation == Formulation::index3)
      throw ParameterError(
          "beta", "0 leaves the positions without influence of the multipliers: formulation index3 needs beta > 0");
    step_.formulation = formulation;
    step_.newton.tolerance = tolerance;
    step_.newton.max_iterations = max_iterations;
    error_.set(0, 0, beta, gamma, formulation == Formulation::stabilised);
  }

  Traits traits() const override {
    const bool stabilised = formulation == Formulation::stabilised;
    return {.order = gamma == 0.5 ? 2 : 1,
            .implicit = true,
            .holds_position = true,
            .holds_velocity = stabilised,
            .friction = stabilised};  // index 3 divides round-off of the positions by h
  }

  void restart(System&, const State& now) override { error_.restart(now); }

  Outcome step(System& s, const State& now, double h, State& next) override {
    step_.dq = h * now.v + h * h * (0.5 - beta) * now.a;
    step_.v = now.v + h * (1 - gamma) * now.a;
    step_.begin(s, now, h, beta * h * h, gamma * h, next);
    step_.extrapolate(now, error_.a_before(), h / error_.h_before(), next);
    while (step_.iterating()) {
      step_.move(s, now, next);
      r_ = -s.f();
      s.add_reaction(1, next.lambda, r_);
      s.add_mass_times(1, next.a, r_);
      step_.correct(s, {1, gamma * h, beta * h * h}, r_, next);
    }
    return step_.finish(s, now, next);
  }

  void accept(System&, const State& /*now*/, const State& next) override { error_.accept(next); }
  double error(System& s, const State& now, const State& next, const Tolerance& t) override {
    return error_(s, now, next, t);
  }
  int error_order() const override { return error_.order(); }
  void archive(Archive& a) override { error_.archive(a); }
  Roots roots(double Omega, double zeta) const override {
    return alpha_roots({.alpha_m = 0, .alpha_f = 0, .beta = beta, .gamma = gamma}, Omega, zeta);
  }

 private:
  NewmarkStep step_;
  NewmarkError error_;
  Vec r_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::newmark_parameters(
    trammel::integrator<Newmark>("newmark", "Newmark's method; beta = 1/4, gamma = 1/2 is the trapezoidal rule")
        .source("Newmark 1959, J. Eng. Mech. Div. ASCE 85(3), 67-94")
        .parameter("beta", &Newmark::beta,
                   {.min = 0, .max = 1, .doc = "share of the new acceleration in the positions; 0 is explicit in q"})
        .parameter("gamma", &Newmark::gamma,
                   {.min = 0,
                    .max = 1,
                    .usual_min = 0.5,
                    .above_min = true,
                    .doc = "share of the new acceleration in the velocities; above 1/2 damps and is of first order"})))
