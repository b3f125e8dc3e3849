// The alpha method of Hilber, Hughes and Taylor for constrained mechanical systems.
//
//     1/(1+alpha) (M a)_{n+1} - (f - W^T lambda)_{n+1} + alpha/(1+alpha) (f - W^T lambda)_n = 0
//     q_{n+1} = q_n (+) (h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1}))
//     v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//     gamma = 1/2 - alpha,   beta = (1 - alpha)^2 / 4,   alpha in [-1/3, 0];   some texts write alpha for our -alpha
//
// with the rows of NewmarkStep (stabilised or index 3). a_n is the method's own: it stands for q'' at t_n + alpha h.
// Negrut, Rampalli, Ottarsson, Sajdak, J. Comput. Nonlinear Dynam. 2(1), 73-85 (2007); Jay, Negrut, ETNA 26, 190-208
// (2007).
#include <trammel/newmark_error.hpp>
#include <trammel/newmark_step.hpp>
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
    gamma_ = 0.5 - alpha;
    beta_ = (1 - alpha) * (1 - alpha) / 4;
    step_.formulation = formulation;
    step_.newton.tolerance = tolerance;
    step_.newton.max_iterations = max_iterations;
    error_.set(0, -alpha, beta_, gamma_);
  }

  Traits traits() const override {
    return {
        .order = 2, .implicit = true, .holds_position = true, .holds_velocity = formulation == Formulation::stabilised};
  }

  void restart(System& s, const State& now) override {
    evaluate_p(s, now);
    error_.restart(now);
  }

  Outcome step(System& s, const State& now, double h, State& next) override {
    step_.dq = h * now.v + h * h * (0.5 - beta_) * now.a;
    step_.v = now.v + h * (1 - gamma_) * now.a;
    step_.begin(s, now, h, beta_ * h * h, gamma_ * h, next);
    while (step_.iterating()) {
      step_.move(s, now, next);
      r_ = alpha / (1 + alpha) * p_ - s.f();
      s.add_reaction(1, next.lambda, r_);
      s.add_mass_times(1 / (1 + alpha), next.a, r_);
      step_.correct(s, {1 / (1 + alpha), gamma_ * h, beta_ * h * h}, r_, next);
    }
    const Outcome outcome = step_.finish(s, now, next);
    if (outcome) keep_p(s, next);
    return outcome;
  }

  void accept(System& s, const State& /*now*/, const State& next) override {
    // Another trial's end than the last one's: evaluate there.
    if (same(next.a, trial_a_) && same(next.lambda, trial_lambda_))
      p_ = trial_p_;
    else
      evaluate_p(s, next);
    error_.accept(next);
  }

  double error(System& s, const State& now, const State& next, const Tolerance& t) override {
    return error_(s, now, next, t);
  }
  int error_order() const override { return error_.order(); }

  void archive(Archive& a) override {
    a("p", p_);
    error_.archive(a);
  }

 private:
  static bool same(const Vec& x, const Vec& y) { return x.size() == y.size() && x == y; }

  void evaluate_p(System& s, const State& at) {
    s.move_to(at.t, at.q, at.v);
    p_ = s.f();
    s.add_reaction(-1, at.lambda, p_);
  }

  // p at the trial's end by the equation just solved, (1 + alpha) p_{n+1} = M a_{n+1} + alpha p_n: no further
  // evaluation of f.
  void keep_p(System& s, const State& next) {
    trial_a_ = next.a;
    trial_lambda_ = next.lambda;
    trial_p_ = alpha / (1 + alpha) * p_;
    s.add_mass_times(1 / (1 + alpha), next.a, trial_p_);
  }

  double gamma_ = 0.5, beta_ = 0.25;
  NewmarkStep step_;
  NewmarkError error_;
  Vec p_;  // f - W^T lambda at the last accepted point
  Vec r_, trial_p_, trial_a_, trial_lambda_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::integrator<HhtAlpha>("hht_alpha", "HHT-alpha: second order, damps the modes too fast for the step")
        .source("Negrut et al. 2007, J. Comput. Nonlinear Dynam. 2(1), 73-85; Jay, Negrut 2007, ETNA 26, 190-208")
        .parameter("alpha", &HhtAlpha::alpha,
                   {.min = -1.0 / 3, .max = 0, .doc = "numerical damping; 0 is the trapezoidal rule without any"})
        .choice("formulation", &HhtAlpha::formulation,
                {{"stabilised", Formulation::stabilised}, {"index3", Formulation::index3}},
                {.doc = "stabilised holds positions and velocities of the rows; index3 positions only"})
        .parameter("tolerance", &HhtAlpha::tolerance,
                   {.min = 0,
                    .max = 1e-2,
                    .usual_max = 1e-8,
                    .above_min = true,
                    .doc = "of Newton's iteration, relative to the size of q and v"})
        .parameter("max_iterations", &HhtAlpha::max_iterations,
                   {.min = 1, .max = 100, .usual_max = 30, .doc = "of Newton, before a step is rejected"}))
