// A bead at the distance s on a straight wire through the origin, turning at W, in gravity: a row that depends on time.
//
//     y cos(W t) = x sin(W t);   s'' = W^2 s - g sin(W t),  s = A cosh(W t) + B sinh(W t) + g/(2 W^2) sin(W t)
//
// Source: Goldstein, Classical Mechanics, section 1.6.
#include <cmath>

#include <trammel/testing/problems.hpp>

namespace trammel::problems {

Problem bead_on_turning_wire(double W) {
  constexpr double g = 9.81, A = 0.5, B = -0.4;
  Problem p{"bead_on_turning_wire", "r'' = (0, -g) - G^T lambda, y cos(W t) - x sin(W t) = 0",
            "Goldstein, section 1.6"};
  p.M = Mat::Identity(2, 2);
  p.force = [](double, const Vec&, const Vec&) -> Vec { return Eigen::Vector2d(0, -g); };
  p.rows = [W](double t, const Vec& q, const Vec& v) -> Problem::Rows {
    const Eigen::Vector2d along(std::cos(W * t), std::sin(W * t)), across(-along[1], along[0]);
    return {Vec::Constant(1, across.dot(q)), Vec::Constant(1, -W * along.dot(q)),
            Vec::Constant(1, 2 * W * along.dot(v) + W * W * across.dot(q)), across.transpose()};
  };
  p.exact = [W](double t, Vec& q, Vec& v) {
    const double c = std::cos(W * t), n = std::sin(W * t), C = g / (2 * W * W);
    const double s = A * std::cosh(W * t) + B * std::sinh(W * t) + C * n;
    const double s_dot = W * (A * std::sinh(W * t) + B * std::cosh(W * t) + C * c);
    q = s * Eigen::Vector2d(c, n);
    v = s_dot * Eigen::Vector2d(c, n) + s * W * Eigen::Vector2d(-n, c);
  };
  return p;
}

}  // namespace trammel::problems
