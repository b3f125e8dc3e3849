#include "control_net.hpp"

#include <cmath>

namespace trammel::plate {

namespace {

// The four control points of a curve in its plane: x, y and weight.
struct Curve {
  std::array<Eigen::Vector2d, 4> point;
  std::array<double, 4> weight{1, 1, 1, 1};
};

Curve line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {.point = {a, (2 * a + b) / 3, (a + 2 * b) / 3, b}};
}

// Of radius 1 about the origin.
Curve arc(double from, double to) {
  const double half = (to - from) / 2, middle = (from + to) / 2, w = std::cos(half);
  const Eigen::Vector2d a(std::cos(from), std::sin(from)), b(std::cos(to), std::sin(to));
  const Eigen::Vector2d corner(std::cos(middle), std::sin(middle));  // times its weight: at distance 1 / w
  const double inner = (1 + 2 * w) / 3;
  return {.point = {a, (a + 2 * corner) / 3 / inner, (2 * corner + b) / 3 / inner, b}, .weight = {1, inner, inner, 1}};
}

// The net of `along_u` x `along_v`, each control point placed by `place(p of u, p of v)`.
template <class Place>
ControlNet product(const Curve& along_u, const Curve& along_v, Place place) {
  ControlNet net{TMesh::uniform(1, 1), Eigen::VectorXd(16), Points(16, 3)};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto k = Eigen::Index(4 * j + i);
      net.weights(k) = along_u.weight[i] * along_v.weight[j];
      net.points.row(k) = place(along_u.point[i], along_v.point[j]).transpose();
    }
  return net;
}

Eigen::Vector3d at(const Frame& frame, double x, double y, double z) {
  return frame.origin + frame.axes * Eigen::Vector3d(x, y, z);
}

}  // namespace

ControlNet rectangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& along_u, const Eigen::Vector3d& along_v) {
  const Curve unit = line({0, 0}, {1, 0});
  return product(unit, unit, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector3d {
    return origin + a.x() * along_u + b.x() * along_v;
  });
}

ControlNet ring(const Frame& frame, double inner, double outer, double from, double to) {
  return product(line({inner, 0}, {outer, 0}), arc(from, to), [&](const Eigen::Vector2d& r, const Eigen::Vector2d& e) {
    return at(frame, r.x() * e.x(), r.x() * e.y(), 0);
  });
}

ControlNet cylinder(const Frame& frame, double radius, double length, double from, double to) {
  return product(arc(from, to), line({0, 0}, {length, 0}), [&](const Eigen::Vector2d& e, const Eigen::Vector2d& z) {
    return at(frame, radius * e.x(), radius * e.y(), z.x());
  });
}

ControlNet sphere(const Frame& frame, double radius, double from, double to, double south, double north) {
  return product(arc(from, to), arc(south, north), [&](const Eigen::Vector2d& e, const Eigen::Vector2d& m) {
    return at(frame, radius * m.x() * e.x(), radius * m.x() * e.y(), radius * m.y());
  });
}

ControlNet refined(const ControlNet& net, const TMesh& fine) {
  const auto op = refinement_operator(TsplineBasis(net.mesh, net.weights), TsplineBasis(fine));
  return {fine, op.weights, op.points * net.points};
}

}  // namespace trammel::plate
