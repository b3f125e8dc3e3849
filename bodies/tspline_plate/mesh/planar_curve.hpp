// Curves that shapes are made of: control points in a plane, with weights and knots.
//
// An arc of at most `largest_arc` is one rational cubic (degree-elevated from the quadratic whose middle weight is
// cos(angle / 2)), exact. A longer one in rational cubics would have joints where only the curve, not its functions, is
// C1; it is a cubic spline instead, C2, through the circle at the knots, tangent to it at both ends (the complete
// spline). Its distance from the circle is of fourth order: 1e-6 of the radius with 48 pieces in the full circle.
// Piegl, Tiller, The NURBS Book, chapters 7 and 9.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace trammel::plate {

inline constexpr double largest_arc = 2.6;    // [rad] of one rational cubic; beyond, its weights differ too much
inline constexpr double largest_piece = 1.6;  // [rad] of a spline's pieces

struct PlanarCurve {
  std::vector<double> knots;  // distinct, 0 to 1
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;
};

PlanarCurve line(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

// An arc of radius 1 about the origin, with angles in rad from the x axis. `knots` (0 to 1) are those of a spline.
// Throws std::invalid_argument if there are too few.
PlanarCurve arc(double from, double to, std::span<const double> knots);

}  // namespace trammel::plate
