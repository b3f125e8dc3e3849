#include "shape_table.hpp"

namespace trammel::beam {

namespace {

// int_0^x Phi_i' Phi_j' for all pairs; the integrand has at most 2N - 1 half waves on the beam.
void foreshortening_at(const Shape& shape, double x, Mat& H) {
  const int N = int(shape.transverse.size());
  const Quadrature rule = gauss_legendre(6 * N + 12, 0, x);
  Mat slopes(rule.x.size(), N);
  for (int i = 0; i < N; ++i)
    for (Eigen::Index k = 0; k < rule.x.size(); ++k) slopes(k, i) = shape.transverse[std::size_t(i)].slope(rule.x(k));
  H = slopes.transpose() * rule.weight.asDiagonal() * slopes;
}

}  // namespace

ShapeTable::ShapeTable(const Shape& shape, const Vec& x, const Vec& weight, bool foreshortening)
    : n_((int(x.size()) + 7) / 8 * 8), transverse_(int(shape.transverse.size())) {
  const int N = transverse_, n_axial = int(shape.axial.size());
  weight_ = Vec::Zero(n_);
  X0_ = Vec::Zero(n_);
  phi_x_ = Mat::Zero(n_, n_axial);
  phi_y_ = Mat::Zero(n_, N);
  slope_y_ = Mat::Zero(n_, N);
  H_ = Mat::Zero(n_, foreshortening ? N * N : 0);
  weight_.head(x.size()) = weight;
  Mat H;
  for (Eigen::Index g = 0; g < x.size(); ++g) {
    X0_(g) = shape.hub_radius + x(g);
    for (int i = 0; i < n_axial; ++i) phi_x_(g, i) = shape.axial[std::size_t(i)].value(x(g));
    for (int i = 0; i < N; ++i) {
      phi_y_(g, i) = shape.transverse[std::size_t(i)].value(x(g));
      slope_y_(g, i) = shape.transverse[std::size_t(i)].slope(x(g));
    }
    if (!foreshortening || N == 0) continue;
    foreshortening_at(shape, x(g), H);
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) H_(g, i * N + j) = H(i, j);
  }
}

}  // namespace trammel::beam
