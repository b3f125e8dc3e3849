// One implicit step of a Newmark-type method (Newmark, HHT-alpha, generalised alpha). The unknowns are the
// accelerations a and multipliers lambda at the step's end; the methods differ only in their equation of motion:
//
//     q_{n+1} = q_n (+) (dq + c_q a_{n+1} + pi),   v_{n+1} = v + c_v a_{n+1}    dq, v: explicit parts of the formulas
//     residual(t, q, v, a, lambda)_{n+1} = 0                                    evaluated by the caller
//     stabilised (index 2):  G v + g_t = 0,   S pi + G^T mu = 0,   g = 0        positions and velocities of the rows
//     index 3:               g = 0            (pi = 0)                          positions only
//
// The stabilised form is that of Gear, Gupta and Leimkuhler (J. Comput. Appl. Math. 12, 77-90, 1985). Its position
// correction pi, of order h^3, is weighted by the iteration matrix S = M + O(h) D + O(h^2) K: by the masses, and by the
// stiffness for modes that are too fast for the step. (Without weights, by G G^T, it would excite the high modes; with
// S the factors of the iteration are used twice.) With sliding friction (W != G) pi needs its own factors: along W^T it
// would move a sliding body along its plane. For a system without rows none of this is computed.
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
  Vec dq, v;  // (nv) explicit parts of the increment and of the new velocity; to be filled before `begin`

  // Predicts lambda_{n+1} = lambda_n and a_{n+1} = a_n. c_q [s^2] >= 0 and c_v [s] > 0 are the weights of a_{n+1}
  // above.
  void begin(const System& s, const State& now, double h, double c_q, double c_v, State& next);
  // Predicts a_{n+1} by the line through a_{n-1} and a_n; `ratio` is the size of this step over that of the last one.
  // Keeps a_n if a changes too fast: extrapolation would amplify a mode that oscillates from step to step. The first
  // increment is then the second difference of a, which measures the step's own error (newmark_error.hpp); Newton's
  // iteration ends at a small part of it.
  void extrapolate(const State& now, const Vec& a_before, double ratio, State& next);
  bool iterating() const { return newton.iterating(); }
  // Computes next.q and next.v from next.a and moves the system to that point.
  void move(System& s, const State& now, State& next);
  // One Newton increment of a, lambda and pi; none if r only confirms that the iteration has converged. `blend` makes S
  // the derivative of r by a; r includes + W^T lambda. The first call replaces the prediction a_{n+1} = a_n, by one
  // that moves q along v_n, if a_n moves q further than v_n and this changes the forces by more than M a_n: then modes
  // oscillate that are too fast for the step (after a refinement or an impact).
  void correct(System& s, Blend blend, const Vec& r, State& next);
  // Satisfies the rows to round-off; next.q and next.v belong to the last a.
  Outcome finish(System& s, const State& now, State& next);

 private:
  void measure(const State& now, double h);
  void find_lead(const State& now, const Vec& a);
  bool correct_rows_alone(System& s, State& next);
  void measure_change(const State& next);
  void factorise(System& s, Blend blend, const State& next);
  void update(const System& s, const State& now, State& next);
  bool correct_rows(System& s, const Vec& r, State& next);
  bool misled(System& s, const Vec& r);  // the prediction by a_n is useless
  bool at_round_off(System& s, const Vec& r);
  bool matters(System& s, const Vec& r);
  bool doubtful(System& s, const Vec& r);  // the factors may hide an error in r

  double c_q_ = 0, c_v_ = 0;
  double size_q_ = 0, size_v_ = 0;      // scales of q and v
  double change_q_ = 0, change_v_ = 0;  // changes by the last increment, relative to these
  Vec sizes_q_;                         // scale of each coordinate, in its own unit
  double change_each_ = 0;              // largest change of a coordinate, relative to its own scale
  Factors of_pi_ = Factors::iteration;  // projection if W != G
  double moved_ = 0;                    // of q since the factors were made, like change_each_
  double h_ = 0;
  bool doubted_ = false;  // the iteration has converged, unless the next r contradicts
  bool leads_ = false;    // a_n moves q further than v_n, by lead_
  Vec pi_, dpi_, zero_;   // empty if there is no pi; zero_ is empty if there are no rows
  Vec increment_, lead_, da_, dlambda_, rc_, mu_;
  Vec first_da_, left_, momentum_;
};

}  // namespace trammel
