// Newmark's method for constrained mechanical systems, to change:
//
//     (M a + W^T lambda - f)_{n+1} = 0
//     q_{n+1} = q_n (+) (h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1}))
//     v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//
// NewmarkStep adds the rows, g = 0 and G v + g_t = 0 (Gear, Gupta, Leimkuhler), and iterates by Newton's method. Second
// order for gamma = 1/2, otherwise first order with damping; stable for every step if 2 beta >= gamma >= 1/2.
#include <trammel/methods/newmark_step.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class MyIntegrator final : public Integrator {
 public:
  double beta = 0.25, gamma = 0.5;

  // Each claim is measured by `trammel check`.
  Traits traits() const override {
    return {.order = gamma == 0.5 ? 2 : 1, .implicit = true, .holds_position = true, .holds_velocity = true};
  }

  void restart(System&, const State&) override {}  // a one-step method has no past to forget

  Outcome step(System& s, const State& now, double h, State& next) override {
    step_.dq = h * now.v + h * h * (0.5 - beta) * now.a;
    step_.v = now.v + h * (1 - gamma) * now.a;
    step_.begin(s, now, h, beta * h * h, gamma * h, next);
    while (step_.iterating()) {
      step_.move(s, now, next);
      residual_ = -s.f();
      s.add_reaction(1, next.lambda, residual_);
      s.add_mass_times(1, next.a, residual_);
      step_.correct(s, {1, gamma * h, beta * h * h}, residual_, next);
    }
    return step_.finish(s, now, next);
  }

 private:
  NewmarkStep step_;
  Vec residual_;  // scratch: it keeps its size, so that a step allocates nothing
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::integrator<MyIntegrator>("my_integrator", "Newmark's method, to change")
        .source("Newmark 1959, J. Eng. Mech. Div. ASCE 85(3), 67-94")
        .parameter("beta", &MyIntegrator::beta,
                   {.min = 0, .max = 1, .above_min = true, .doc = "share of the new acceleration in the positions"})
        .parameter("gamma", &MyIntegrator::gamma,
                   {.min = 0.5, .max = 1, .doc = "share of it in the velocities; above 1/2 damps"}))
