// Collocation at Lobatto's five points where small oscillations are followed exactly: what v_0 and the rest n of the acceleration,
// a polynomial through its values n_j, do to the solution at a part theta of a step h.
//
//     x(theta) = t v_0 + sum_j x_j n_j + Phi (x_0 Psi v_0 + sum_j x_n,j Psi n_j),    t = theta h
//     v(theta) =   v_0 + sum_j v_j n_j + Phi (v_0 Psi v_0 + sum_j v_n,j Psi n_j)
#pragma once

#include <trammel/types.hpp>

namespace trammel::collocation {

constexpr int points = 5, last = points - 1, middle = points / 2;
using Points = Eigen::Matrix<double, points, 1>;

// The points, (1 -+ sqrt(3/7))/2 beside the ends and the middle.
inline constexpr double c[points] = {0, 0.17267316464601142810, 0.5, 0.82732683535398857190, 1};

// l_j(theta), Lagrange's polynomials of the points; theta may lie outside of the step.
Points lagrange(double theta);

struct Weights {
  double theta = 0, t = 0;
  Points x, v;   // of n_j where no mode is
  Vec x_0, v_0;  // of a mode's Psi v_0 (count), beyond t and 1
  Mat x_n, v_n;  // of its Psi n_j (count x points), beyond x and v
};

// omega (count) [1/s], all > 0.
void weigh(const Vec& omega, double theta, double h, Weights& w);

}  // namespace trammel::collocation
