#include "tspline_plate/mesh/planar_curve.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/LU>

#include "tspline_plate/mesh/blending.hpp"

namespace trammel::plate {

PlanarCurve line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {{0, 1}, {a, (2 * a + b) / 3, (a + 2 * b) / 3, b}, {1, 1, 1, 1}};
}

namespace {

Eigen::Vector2d direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

PlanarCurve rational_arc(double from, double to) {
  const double w = std::cos((to - from) / 2), inner = (1 + 2 * w) / 3;
  const Eigen::Vector2d a = direction(from), b = direction(to);
  const Eigen::Vector2d corner = direction((from + to) / 2);  // times its weight: at distance 1 / w
  return {{0, 1}, {a, (a + 2 * corner) / 3 / inner, (2 * corner + b) / 3 / inner, b}, {1, inner, inner, 1}};
}

// Ends and slopes there give two points each; the others follow from the values at inner knots.
PlanarCurve spline_arc(double from, double to, std::span<const double> t) {
  const auto pieces = Eigen::Index(t.size()) - 1;
  const auto angle = [&](std::size_t k) { return from + t[k] * (to - from); };
  const auto slope = [&](std::size_t k) -> Eigen::Vector2d {
    return (to - from) * Eigen::Vector2d(-std::sin(angle(k)), std::cos(angle(k)));
  };
  std::vector<double> open(3, t.front());
  open.insert(open.end(), t.begin(), t.end());
  open.insert(open.end(), 3, t.back());

  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(pieces + 3, pieces + 3);
  Eigen::MatrixX2d wanted(pieces + 3, 2);
  const auto given = [&](Eigen::Index point, const Eigen::Vector2d& place) {
    values(point, point) = 1;
    wanted.row(point) = place.transpose();
  };
  const std::size_t last = t.size() - 1;
  given(0, direction(angle(0)));
  given(1, direction(angle(0)) + (t[1] - t[0]) / 3 * slope(0));
  given(pieces + 1, direction(angle(last)) - (t[last] - t[last - 1]) / 3 * slope(last));
  given(pieces + 2, direction(angle(last)));
  for (std::size_t k = 1; k < last; ++k) {  // row k + 1: the value at knot k
    for (std::size_t i = k; i <= k + 2; ++i) {
      const LocalKnots local{open[i], open[i + 1], open[i + 2], open[i + 3], open[i + 4]};
      values(Eigen::Index(k) + 1, Eigen::Index(i)) = blossom(local, span_of(local, t[k], t[k + 1]), t[k], t[k], t[k]);
    }
    wanted.row(Eigen::Index(k) + 1) = direction(angle(k)).transpose();
  }
  const Eigen::MatrixX2d found = values.partialPivLu().solve(wanted);

  PlanarCurve curve{{t.begin(), t.end()}, {}, std::vector<double>(std::size_t(pieces) + 3, 1.0)};
  for (Eigen::Index i = 0; i < found.rows(); ++i) curve.points.push_back(found.row(i).transpose());
  return curve;
}

}  // namespace

PlanarCurve arc(double from, double to, std::span<const double> knots) {
  if (to - from <= largest_arc) return rational_arc(from, to);
  for (std::size_t k = 1; k < knots.size(); ++k)
    if ((knots[k] - knots[k - 1]) * (to - from) > largest_piece)
      throw std::invalid_argument(
          fmt::format("an arc of {:.4g} rad is a spline whose pieces are {} rad at most; found one of {:.4g} rad, take "
                      "more elements round it",
                      to - from, largest_piece, (knots[k] - knots[k - 1]) * (to - from)));
  return spline_arc(from, to, knots);
}

}  // namespace trammel::plate
