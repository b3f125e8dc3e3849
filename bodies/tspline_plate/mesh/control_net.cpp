#include "tspline_plate/mesh/control_net.hpp"

namespace trammel::plate {

namespace {

// The net of `along_u` x `along_v`, each control point placed by `place(p of u, p of v)`.
template <class Place>
ControlNet product(const PlanarCurve& along_u, const PlanarCurve& along_v, Place place) {
  const std::size_t n = along_u.points.size(), m = along_v.points.size();
  ControlNet net{TMesh::tensor(along_u.knots, along_v.knots), Eigen::VectorXd(Eigen::Index(n * m)),
                 Points(Eigen::Index(n * m), 3)};
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = Eigen::Index(n * j + i);
      net.weights(k) = along_u.weights[i] * along_v.weights[j];
      net.points.row(k) = place(along_u.points[i], along_v.points[j]).transpose();
    }
  return net;
}

Eigen::Vector3d at(const Frame& frame, double x, double y, double z) {
  return frame.origin + frame.axes * Eigen::Vector3d(x, y, z);
}

}  // namespace

ControlNet rectangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& along_u, const Eigen::Vector3d& along_v) {
  const PlanarCurve unit = line({0, 0}, {1, 0});
  return product(unit, unit, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector3d {
    return origin + a.x() * along_u + b.x() * along_v;
  });
}

ControlNet ring(const Frame& frame, double inner, double outer, double from, double to, Knots knots) {
  return product(
      line({inner, 0}, {outer, 0}), arc(from, to, knots),
      [&](const Eigen::Vector2d& r, const Eigen::Vector2d& e) { return at(frame, r.x() * e.x(), r.x() * e.y(), 0); });
}

ControlNet cylinder(const Frame& frame, double radius, double length, double from, double to, Knots knots) {
  return product(arc(from, to, knots), line({0, 0}, {length, 0}),
                 [&](const Eigen::Vector2d& e, const Eigen::Vector2d& z) {
                   return at(frame, radius * e.x(), radius * e.y(), z.x());
                 });
}

ControlNet sphere(const Frame& frame, double radius, double from, double to, double south, double north, Knots knots) {
  return product(arc(from, to, knots), arc(south, north, {}), [&](const Eigen::Vector2d& e, const Eigen::Vector2d& m) {
    return at(frame, radius * m.x() * e.x(), radius * m.x() * e.y(), radius * m.y());
  });
}

ControlNet refined(const ControlNet& net, const TMesh& fine) {
  const auto op = refinement_operator(TsplineBasis(net.mesh, net.weights), TsplineBasis(fine));
  return {fine, op.weights, op.points * net.points};
}

}  // namespace trammel::plate
