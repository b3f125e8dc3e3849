// The alpha methods: Newmark's formulas with accelerations a of the method's own, which follow the true ones A = q'' by weights
// (Arnold's and Bruls' form). HHT-alpha and generalised alpha are choices of the weights.
//
//     (M A + W^T lambda - f)_{n+1} = 0
//     (1 - alpha_m) a_{n+1} + alpha_m a_n = (1 - alpha_f) A_{n+1} + alpha_f A_n
//     q_{n+1} = q_n (+) (h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1}))
//     v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//
// with the rows of NewmarkStep. a_n stands for q'' at t_n + (alpha_m - alpha_f) h; the equation of motion is met at t_{n+1} by what
// belongs there, M, f and A. So q, v and lambda are of second order for gamma = 1/2 + alpha_f - alpha_m, whether M varies or not.
// (Weighing M a and f instead, the form these methods were first printed in, is the same while M is constant, and else puts M at
// another instant than a: first order.) Arnold, Bruls, Multibody Syst. Dyn. 18, 185-202 (2007).
#pragma once

#include <trammel/methods/newmark_error.hpp>
#include <trammel/methods/newmark_step.hpp>

namespace trammel {

class AlphaMethod {
 public:
  struct Weights {
    double alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;
  };
  NewmarkStep newmark;

  void set(const Weights& weights, Formulation formulation);
  void restart(const State& now);
  Outcome step(System& s, const State& now, double h, State& next);  // next.a is A_{n+1}
  void accept(const State& next);
  double error(System& s, const State& now, const State& next, const Tolerance& t) { return error_(s, now, next, t); }
  int error_order() const { return error_.order(); }
  void archive(Archive& archive);

 private:
  Weights w_;
  NewmarkError error_;
  Vec a_, A_;  // at the last accepted point
  Vec known_, r_;
};

}  // namespace trammel
