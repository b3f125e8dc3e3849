// The equations of motion as a differential-algebraic system F(t, y, y') = 0 of index 2 in the unknowns
// y = (q, v, lambda, pi, mu), after Gear, Gupta and Leimkuhler (J. Comput. Appl. Math. 12, 77-90, 1985):
//
//     q' - N(q) (v - pi) = 0                   pi (nv): moves q back onto the rows, along M^-1 G^T
//     M v' - f + W^T lambda = 0
//     G v + g_t = 0
//     M pi + G^T mu = 0,   g = 0               solutions have pi = 0, mu = 0
//
// Without rows y = (q, v). The linear equations J x = b of Newton's iteration, J = dF/dy + c dF/dy', are reduced to two
// solutions with the System's own factors, in increments xi of q (dq = N xi + what leaves the manifold):
//
//     [M G^T; G 0] (dpi, dmu) = (b_4, b_3 - d(G v)/dq xi_b - c (b_5 - G xi_b)),   xi_b = N^+ b_1 / c
//     [S W^T; G 0] (xi, dlambda/c^2) = (b_2 + (c M + D) z, b_5)/(c^2, 1),   S = M + D/c + K/c^2,   z = c xi_b - dpi
//     dv = c (xi - xi_b) + dpi
//
// In the first iteration b_1 is large, so xi_b needs d(G v)/dq, D and dN/dq, which are taken as differences. For the
// rest of xi they are left out if they are of the order of h |v|/length, relative to the kept terms.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel::ida {

class Equations {
 public:
  // Begins with this system, which all functions below use; it is at a state with consistent a and lambda.
  void restart(System& s);
  void use(System& s);  // the same system, whose factors others may have replaced

  Eigen::Index size() const { return nc_ > 0 ? nq_ + 2 * nv_ + 2 * nc_ : nq_ + nv_; }
  Eigen::Index differential() const { return nq_ + nv_; }  // they come first
  void start(const State& now, double* y, double* y_dot) const;

  // These return false if numbers are not finite or a matrix is singular: a shorter step may help.
  bool residual(double t, const double* y, const double* y_dot, double* F);
  bool factorise(double t, double c, const double* y, const double* y_dot);
  bool solve(const double* b, double* x);

  // Moves q and v onto the rows by the least change in the metric of M; false: no convergence.
  bool project(System& s, double t, Vec& q, Vec& v);

 private:
  using View = Eigen::Map<const Vec>;
  struct Point {
    double t = 0;
    Vec q, v, lambda, pi, mu, q_dot, a;
  };
  void read(double t, const double* y, const double* y_dot, Point& to) const;
  bool factors_at(const Point& at, double c);
  void find_redundant_part(const Vec& multipliers, Vec& part);
  void measure_tangent(const double* b);
  void measure_turning();
  bool solve_projection(const double* b);
  void add_damping(const Vec& z, Vec& r);
  bool settle_positions(System& s, double t, Vec& q, Vec& v);

  System* system_ = nullptr;
  Eigen::Index nq_ = 0, nv_ = 0, nc_ = 0;
  bool flat_ = true;                     // q' = v
  bool stale_ = true;                    // the System's factors may belong to others
  Point at_, set_up_;                    // of the last residual, of the last factorisation
  double c_ = 1;                         // of the last factorisation
  Vec applied_;                          // -f + W^T lambda at at_
  Vec rates_;                            // G v + g_t there
  Vec turned_;                           // its change by xi_b_
  Vec redundant_lambda_, redundant_mu_;  // parts without a force, to be removed by the next solution
  Vec xi_b_, off_, xi_, dpi_, dmu_, dlambda_, z_, r_, rc_, moved_, zero_, zero_rows_, q_, change_;
};

}  // namespace trammel::ida
