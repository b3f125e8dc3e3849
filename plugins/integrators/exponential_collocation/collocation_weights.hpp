// Weights of collocation at Lobatto's seven points with exact small oscillations. Each oscillator starts with the
// velocity eta_0; the remaining force on it is a polynomial through the values nu_j. At theta in [0, 1] of a step h:
//
//     xi(theta)  = x_0 eta_0 + sum_j x_j nu_j
//     eta(theta) = eta_0 + v_0 eta_0 + sum_j v_j nu_j
//
//     x_0 = sin(omega t)/omega,  x_j = int_0^t sin(omega (t - tau))/omega l_j(tau) dtau
//     v_0 = cos(omega t) - 1,    v_j = int_0^t cos(omega (t - tau)) l_j(tau) dtau
//
// with t = theta h and Lagrange's polynomials l_j.
#pragma once

#include <trammel/types.hpp>

namespace trammel::collocation {

constexpr int points = 7, last = points - 1, middle = points / 2;
using Points = Eigen::Matrix<double, points, 1>;

// The points: the ends, the middle and (1 -+ sqrt((5 +- 2 sqrt(5/3))/11))/2.
inline constexpr double c[points] = {
    0, 0.08488805186071653506, 0.26557560326464289310, 0.5, 0.73442439673535710690, 0.91511194813928346494, 1};

// l_j(theta), Lagrange's polynomials of the points; theta may lie outside of the step.
Points lagrange(double theta);

// Weights of the values that give the middle value minus that of the polynomial through the others.
const Points& beyond_others();

struct Weights {
  double t = 0;
  Points integral;  // of l_j from 0 to t
  Vec x_0, v_0;     // (omega's)
  Mat x, v;         // (omega's x points)
};

// omega [1/s], of any length; omega = 0: a free coordinate.
void weigh(const Vec& omega, double theta, double h, Weights& w);

}  // namespace trammel::collocation
