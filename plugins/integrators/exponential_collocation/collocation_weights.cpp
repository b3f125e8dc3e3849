#include "collocation_weights.hpp"

#include <Eigen/LU>

#include "oscillator_moments.hpp"

namespace trammel::collocation {

namespace {

Points powers_of(double theta) {
  Points powers;
  powers[0] = 1;
  for (int k = 1; k < points; ++k) powers[k] = theta * powers[k - 1];
  return powers;
}

// Column j: of l_j, constant first.
const Eigen::Matrix<double, points, points>& lagrange_coefficients() {
  static const Eigen::Matrix<double, points, points> coefficients = [] {
    Eigen::Matrix<double, points, points> powers;
    for (int i = 0; i < points; ++i) powers.row(i) = powers_of(c[i]).transpose();
    return powers.inverse().eval();
  }();
  return coefficients;
}

}  // namespace

Points lagrange(double theta) {
  return lagrange_coefficients().transpose() * powers_of(theta);
}

void weigh(const Vec& omega, double theta, double h, Weights& w) {
  w.theta = theta, w.t = theta * h;
  Points free_c, free_s, extra_c, extra_s;
  for (int k = 0; k < points; ++k) free_c[k] = 1.0 / (k + 1), free_s[k] = free_c[k] / (k + 2);
  const Eigen::Matrix<double, points, points> of_points =
      lagrange_coefficients().transpose() * powers_of(theta).asDiagonal();
  w.v = w.t * (of_points * free_c), w.x = w.t * w.t * (of_points * free_s);
  w.x_0.resize(omega.size()), w.v_0.resize(omega.size());
  w.x_n.resize(omega.size(), points), w.v_n.resize(omega.size(), points);
  for (Eigen::Index i = 0; i < omega.size(); ++i) {
    const auto m = oscillator_moments<points>(omega[i] * w.t);
    w.v_0[i] = m.cosine - 1, w.x_0[i] = w.t * (m.sine - 1);
    for (int k = 0; k < points; ++k)
      extra_c[k] = m.c[std::size_t(k)] - free_c[k], extra_s[k] = m.s[std::size_t(k)] - free_s[k];
    w.v_n.row(i) = w.t * (of_points * extra_c), w.x_n.row(i) = w.t * w.t * (of_points * extra_s);
  }
}

}  // namespace trammel::collocation
