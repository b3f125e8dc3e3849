// The alpha methods: Newmark's formulas with auxiliary accelerations a, which a weighted mean relates to the true ones
// A = q'' (the form of Arnold and Bruls). HHT-alpha and generalised alpha are choices of the weights.
//
//     (M A + W^T lambda - f)_{n+1} = 0
//     (1 - alpha_m) a_{n+1} + alpha_m a_n = (1 - alpha_f) A_{n+1} + alpha_f A_n
//     q_{n+1} = q_n (+) (h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1}))
//     v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//
// with the rows of NewmarkStep. a_n approximates q'' at t_n + (alpha_m - alpha_f) h. M, f and A of the equation of
// motion are all evaluated at t_{n+1}, so that q, v and lambda are of second order for gamma = 1/2 + alpha_f - alpha_m,
// also if M varies. (The original form takes weighted means of M a and of f. It is the same for constant M; if M
// varies, it combines M and a of different instants and is of first order.) Arnold, Bruls, Multibody Syst. Dyn. 18,
// 185-202 (2007).
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
