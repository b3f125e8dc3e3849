// One implicit step of a Newmark-type method (Newmark, HHT-alpha, generalised alpha), whose unknowns are the
// accelerations a and multipliers lambda at the step's end and which differ in their equation of motion only:
//
//     q_{n+1} = q_n (+) (dq + c_q a_{n+1} + pi),   v_{n+1} = v + c_v a_{n+1}    dq, v: what Newmark's formulas know
//     residual(t, q, v, a, lambda)_{n+1} = 0                                    the method's own, left to the caller
//     stabilised (index 2):  G v + g_t = 0,   S pi + G^T mu = 0,   g = 0        both hold at the step's end
//     index 3:               g = 0            (pi = 0)                          only the positions hold
//
// The stabilised form is that of Gear, Gupta and Leimkuhler (J. Comput. Appl. Math. 12, 77-90, 1985). Its position
// correction pi, of the order h^3, is weighted by the iteration matrix S = M + O(h) D + O(h^2) K: by the masses, and by
// the stiffness where a mode is too fast for the step. (Unweighted, by G G^T, it would bend the high modes; and with S
// the factors of the iteration serve twice.) Where sliding friction tilts the reactions, W != G, pi takes factors of its own:
// along W^T it would move what slides along its plane. A system without rows pays for nothing of this.
//
//     step.dq = h * now.v + ...;   step.v = now.v + ...;
//     step.begin(s, now, h, c_q, c_v, next);
//     step.extrapolate(now, a_before, h / h_before, next);          where there is a step before
//     while (step.iterating()) {
//       step.move(s, now, next);
//       r = ...;
//       step.correct(s, blend, r, next);
//     }
//     return step.finish(s, now, next);
#pragma once

#include <trammel/integrator.hpp>
#include <trammel/methods/newton.hpp>

namespace trammel {

enum class Formulation { stabilised, index3 };

class NewmarkStep {
 public:
  Formulation formulation = Formulation::stabilised;
  Newton newton;
  Vec dq, v;  // (nv) what the formulas know of the increment and the new velocity; filled before `begin`

  // Predicts lambda_{n+1} = lambda_n and a_{n+1} = a_n. c_q [s^2] >= 0, c_v [s] > 0: shares of a_{n+1} in dq and v.
  void begin(const System& s, const State& now, double h, double c_q, double c_v, State& next);
  // Predicts a_{n+1} by the line through a_{n-1} and a_n, `ratio` steps of then ahead, unless a changes too fast for that: a mode that
  // rings from step to step would only be enlarged. By the second difference of a, which the first increment then is, the step's own
  // error is measured (newmark_error.hpp); Newton's iteration ends at a small share of it.
  void extrapolate(const State& now, const Vec& a_before, double ratio, State& next);
  bool iterating() const { return newton.iterating(); }
  // next.q and next.v from next.a; the system to that point.
  void move(System& s, const State& now, State& next);
  // One Newton increment of a, lambda and pi. `blend` makes S the derivative of r by a; r holds + W^T lambda.
  // Before the first one, where q would go further by a_n than by v_n and that changes forces by more than a_n itself is worth, modes
  // swing that are too fast for the step (a refinement has made them, or an impact woken): a_{n+1} is then such that q goes along v_n.
  void correct(System& s, Blend blend, const Vec& r, State& next);
  // Rows to round-off; next.q and next.v are those of the last a.
  Outcome finish(System& s, const State& now, State& next);

 private:
  void measure(const State& now, double h);
  void find_lead(const State& now, const Vec& a);
  bool correct_rows_alone(System& s, State& next);
  void measure_change(const State& next);
  void factorise(System& s, Blend blend, const State& next);
  void update(const System& s, const State& now, State& next);
  bool correct_rows(System& s, const Vec& r, State& next);
  bool misled(System& s, const Vec& r);  // by a_n
  bool at_round_off(System& s, const Vec& r);

  double c_q_ = 0, c_v_ = 0;
  double size_q_ = 0, size_v_ = 0;      // of q and v
  double change_q_ = 0, change_v_ = 0;  // by the last increment, relative to them
  Vec sizes_q_;                         // of each coordinate, in its own unit
  double change_each_ = 0;              // of the coordinate that changed most, relative to its own size
  Factors of_pi_ = Factors::iteration;  // projection where they differ
  double moved_ = 0;                    // of q since the factors were made, like change_each_
  double h_ = 0;
  bool leads_ = false;   // a_n further than v_n, by lead_
  Vec pi_, dpi_, zero_;  // empty where there is no pi; zero_ where there are no rows
  Vec increment_, lead_, da_, dlambda_, rc_, mu_;
};

}  // namespace trammel
