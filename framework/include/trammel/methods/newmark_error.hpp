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
  // Of the accepted point before the last, and the step from there; empty just after a restart.
  const Vec& a_before() const { return a_before_; }
  double h_before() const { return h_before_; }
  int order() const { return first_ == 0 || !of_velocities_ ? 3 : 2; }
  void archive(Archive& a);

 private:
  double first_ = 0, of_q_ = 0, of_v_ = 0;  // C_1, C_q, C_v
  bool of_velocities_ = true;
  double t_ = 0, h_before_ = 0;  // time of the last accepted point; size of the step that led to it
  Vec a_, a_before_;             // at the last accepted point and the one before it; empty: none
  Vec q_, v_, rate_, e_q_, e_v_, along_, lambda_;
  ErrorAlongRows along_rows_;  // used if the velocity rows are satisfied, too
};

}  // namespace trammel
