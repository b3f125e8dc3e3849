#include "point_shape.hpp"

#include <trammel/quadrature.hpp>

#include "vector_loops.hpp"

namespace trammel::beam {

namespace {

// f of the i-th function: modes first, then static functions.
template <class Modes, class Statics, class F>
double of_function(const Modes& modes, const Statics& statics, int i, F&& f) {
  const auto k = std::size_t(i);
  return k < modes.size() ? f(modes[k]) : f(statics[k - modes.size()]);
}

}  // namespace

double Shape::phi_x(int i, double x) const {
  return of_function(axial, static_axial, i, [x](const auto& s) { return s.value(x); });
}
double Shape::phi_y(int i, double x) const {
  return of_function(transverse, static_transverse, i, [x](const auto& s) { return s.value(x); });
}
double Shape::slope_y(int i, double x) const {
  return of_function(transverse, static_transverse, i, [x](const auto& s) { return s.slope(x); });
}

std::vector<PointShape> shapes_at(const Shape& shape, const Vec& x, bool foreshortening) {
  const int n_axial = shape.axial_count(), N = shape.transverse_count();
  // A product of two slopes has at most 2 N - 1 half waves on the beam.
  const Quadrature unit = foreshortening && N > 0 ? gauss_legendre(6 * N + 12, 0, 1) : Quadrature{};
  Mat slopes(unit.x.size(), N);

  std::vector<PointShape> points(std::size_t(x.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    PointShape& at = points[std::size_t(k)];
    at.X0 = shape.hub_radius + x(k);
    at.phi_x = Vec::NullaryExpr(n_axial, [&](Eigen::Index i) { return shape.phi_x(int(i), x(k)); });
    at.phi_y = Vec::NullaryExpr(N, [&](Eigen::Index i) { return shape.phi_y(int(i), x(k)); });
    at.slope_y = Vec::NullaryExpr(N, [&](Eigen::Index i) { return shape.slope_y(int(i), x(k)); });
    if (!foreshortening) continue;
    for (int i = 0; i < N; ++i)
      for (Eigen::Index g = 0; g < unit.x.size(); ++g) slopes(g, i) = shape.slope_y(i, x(k) * unit.x(g));
    at.H = Mat::Zero(padded(N), N);
    at.H.topRows(N) = slopes.transpose() * (x(k) * unit.weight).asDiagonal() * slopes;
  }
  return points;
}

}  // namespace trammel::beam
