// The local error of a Newmark-type method, from differences of its accelerations:
//
//     e_q = C_q h^2 (a_{n+1} - a_n)                                          third order in h
//     e_v = C_1 h (a_{n+1} - a_n) + C_v h (second difference of a)           C_1 = 0 for a method of second order
//
// The second difference h^2 a'' uses a_{n-1} of the last accepted step. Directly after a restart it does not exist;
// then a' at the step's start is found by a difference with one more solve for the acceleration, h/1000 ahead. For the
// generalised-alpha family, with delta = alpha_m - alpha_f and a_n = q''(t_n + delta h) + O(h^2) in Newmark's formulas,
// Taylor's expansion gives
//
//     C_1 = gamma - 1/2 + delta,   C_q = beta + delta/2 - 1/6,
//     C_v = (delta (2 alpha_m - 1) + gamma (1 + 2 delta) - 1/3)/2
//
// For modes that are too fast for the step, h omega >> 1, this is not the error: their accelerations oscillate from
// step to step, and e_v does not decrease with h, so that the step would shrink until it resolves them. If the error
// exceeds the tolerance, it is filtered by the iteration matrix S = M + c_v D + c_q K of the step's end (Hairer,
// Wanner, Solving ODEs II, IV.8, after Shampine):
//
//     [S G^T; G 0] (x, mu) = (M e, G e)      for a mode  x = e/(1 + z), z = c_q omega^2
//     e_q -> x,   e_v -> x + (e - x) z^(-1/2) where z > 1
//
// For a mode that oscillates with amplitude A in the accelerations, e_q becomes its displacement, A/omega^2; for one
// with amplitude V in v, h times e_v becomes V/omega, the oscillation that it would have in shorter steps. Modes that
// the step resolves, z < 1, keep their e_v, and their e_q up to a part of (omega h)^2, which is as small as the next
// term of the estimate.
//
// Near a change of rank, round-off of the position and velocity rows enters a divided by h: see error_along_rows.hpp.
#pragma once

#include <trammel/integrator.hpp>
#include <trammel/methods/error_along_rows.hpp>

namespace trammel {

class NewmarkError {
 public:
  // `of_velocities` false: only the part of e_q along the rows counts. It is for formulation index3, whose positions
  // satisfy the rows while its velocities and accelerations oscillate across them (Negrut et al. 2007).
  void set(double alpha_m, double alpha_f, double beta, double gamma, bool of_velocities = true);
  void restart(const State& now);
  void accept(const State& next);
  double operator()(System& s, const State& now, const State& next, const Tolerance& tolerance);
  // a at the accepted point before the last one, and the size of the step from there; empty just after a restart.
  const Vec& a_before() const { return a_before_; }
  double h_before() const { return h_before_; }
  int order() const { return first_ == 0 || !of_velocities_ ? 3 : 2; }
  void archive(Archive& a);

 private:
  bool has_step_before(const State& now) const { return a_before_.size() == now.a.size() && h_before_ > 0; }
  void find_rate(System& s, const State& now, double h);
  double norm(System& s, const State& now, const State& next, const Vec& e_v, const Tolerance& tolerance);
  [[nodiscard]] bool filter(System& s, const Vec& e, Vec& x);

  double first_ = 0, of_q_ = 0, of_v_ = 0;  // C_1, C_q, C_v
  double c_q_ = 0, c_v_ = 0;                // c_q/h^2, c_v/h
  bool of_velocities_ = true;
  double t_ = 0, h_before_ = 0;  // time of the last accepted point; size of the step that led to it
  Vec a_, a_before_;             // at the last accepted point and the one before it; empty: none
  Vec q_, v_, rate_, e_q_, e_v_, along_, lambda_;
  Vec slow_q_, slow_v_, fast_, momentum_, of_rows_, mu_;
  ErrorAlongRows along_rows_;  // used if the velocity rows are satisfied, too
};

}  // namespace trammel
