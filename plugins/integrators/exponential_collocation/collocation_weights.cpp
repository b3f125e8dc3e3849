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

// Column j: coefficients of l_j, the constant first.
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

const Points& beyond_others() {
  static const Points weights = [] {
    Points w;
    for (int j = 0; j < points; ++j) {
      w[j] = j == middle ? 1 : -1;
      for (int m = 0; m < points; ++m)
        if (j != middle && m != j && m != middle) w[j] *= (c[middle] - c[m]) / (c[j] - c[m]);
    }
    return w;
  }();
  return weights;
}

void weigh(const Vec& omega, double theta, double h, Weights& w) {
  w.t = theta * h;
  const Eigen::Matrix<double, points, points> of_points =
      lagrange_coefficients().transpose() * powers_of(theta).asDiagonal();
  w.integral.setZero();
  for (int k = 0; k < points; ++k) w.integral += w.t / (k + 1) * of_points.col(k);
  w.x_0.resize(omega.size()), w.v_0.resize(omega.size());
  w.x.resize(omega.size(), points), w.v.resize(omega.size(), points);
  for (Eigen::Index i = 0; i < omega.size(); ++i) {
    const auto m = oscillator_moments<points>(omega[i] * w.t);
    w.x_0[i] = w.t * m.sine, w.v_0[i] = m.cosine - 1;
    w.x.row(i) = w.t * w.t * (of_points * Eigen::Map<const Points>(m.s.data()));
    w.v.row(i) = w.t * (of_points * Eigen::Map<const Points>(m.c.data()));
  }
}

}  // namespace trammel::collocation
