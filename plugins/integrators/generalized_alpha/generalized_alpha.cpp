// The generalised-alpha method for constrained mechanical systems, with Arnold's and Bruls' recursion for the method's
// own accelerations a beside the true ones A = q'':
//
//     (M A + W^T lambda - f)_{n+1} = 0
//     (1 - alpha_m) a_{n+1} + alpha_m a_n = (1 - alpha_f) A_{n+1} + alpha_f A_n
//     q_{n+1} = q_n (+) (h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1}))
//     v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//     alpha_m = (2 rho - 1)/(rho + 1),   alpha_f = rho/(rho + 1)
//     gamma = 1/2 + alpha_f - alpha_m,   beta = (gamma + 1/2)^2 / 4
//
// rho in [0, 1] is the spectral radius for infinitely fast modes. Rows as in NewmarkStep (stabilised or index 3).
// Chung, Hulbert, J. Appl. Mech. 60(2), 371-375 (1993); Arnold, Bruls, Multibody Syst. Dyn. 18, 185-202 (2007).
#include <trammel/newmark_error.hpp>
#include <trammel/newmark_step.hpp>
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
    alpha_m_ = (2 * rho_inf - 1) / (rho_inf + 1);
    alpha_f_ = rho_inf / (rho_inf + 1);
    gamma_ = 0.5 + alpha_f_ - alpha_m_;
    beta_ = (gamma_ + 0.5) * (gamma_ + 0.5) / 4;
    step_.formulation = formulation;
    step_.newton.tolerance = tolerance;
    step_.newton.max_iterations = max_iterations;
    error_.set(alpha_m_, alpha_f_, beta_, gamma_);
  }

  Traits traits() const override {
    return {
        .order = 2, .implicit = true, .holds_position = true, .holds_velocity = formulation == Formulation::stabilised};
  }

  void restart(System&, const State& now) override {
    A_ = now.a;
    a_ = now.a;
    error_.restart(now);
  }

  Outcome step(System& s, const State& now, double h, State& next) override {
    // a_{n+1} = known + share A_{n+1}
    const double share = (1 - alpha_f_) / (1 - alpha_m_);
    known_ = (alpha_f_ * A_ - alpha_m_ * a_) / (1 - alpha_m_);
    step_.dq = h * now.v + h * h * ((0.5 - beta_) * a_ + beta_ * known_);
    step_.v = now.v + h * ((1 - gamma_) * a_ + gamma_ * known_);
    const double c_q = beta_ * h * h * share, c_v = gamma_ * h * share;
    step_.begin(s, now, h, c_q, c_v, next);
    while (step_.iterating()) {
      step_.move(s, now, next);
      r_ = -s.f();
      s.add_reaction(1, next.lambda, r_);
      s.add_mass_times(1, next.a, r_);
      step_.correct(s, {1, c_v, c_q}, r_, next);
    }
    return step_.finish(s, now, next);
  }

  void accept(System&, const State& /*now*/, const State& next) override {
    a_ = ((1 - alpha_f_) * next.a + alpha_f_ * A_ - alpha_m_ * a_) / (1 - alpha_m_);
    A_ = next.a;
    error_.accept(next);
  }

  double error(System& s, const State& now, const State& next, const Tolerance& t) override {
    return error_(s, now, next, t);
  }
  int error_order() const override { return error_.order(); }

  void archive(Archive& archive) override {
    archive("a", a_);
    archive("A", A_);
    error_.archive(archive);
  }

 private:
  double alpha_m_ = 0, alpha_f_ = 0, gamma_ = 0.5, beta_ = 0.25;
  NewmarkStep step_;
  NewmarkError error_;
  Vec a_, A_;  // at the last accepted point
  Vec known_, r_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::integrator<GeneralizedAlpha>("generalized_alpha",
                                          "generalised alpha: second order, damping chosen by rho_inf")
        .source(
            "Chung, Hulbert 1993, J. Appl. Mech. 60(2), 371-375; Arnold, Bruls 2007, Multibody Syst. Dyn. 18, 185-202")
        .parameter(
            "rho_inf", &GeneralizedAlpha::rho_inf,
            {.min = 0,
             .max = 1,
             .doc =
                 "spectral radius for infinitely fast modes: 1 no damping (weakly unstable with index3), 0 one step"})
        .choice("formulation", &GeneralizedAlpha::formulation,
                {{"stabilised", Formulation::stabilised}, {"index3", Formulation::index3}},
                {.doc = "stabilised holds positions and velocities of the rows; index3 positions only"})
        .parameter("tolerance", &GeneralizedAlpha::tolerance,
                   {.min = 0,
                    .max = 1e-2,
                    .usual_max = 1e-8,
                    .above_min = true,
                    .doc = "of Newton's iteration, relative to the size of q and v"})
        .parameter("max_iterations", &GeneralizedAlpha::max_iterations,
                   {.min = 1, .max = 100, .usual_max = 30, .doc = "of Newton, before a step is rejected"}))
