// A heavy symmetric top on its tip: q a unit quaternion, world from body, omega in body axes.
//
//     J omega' = -omega x J omega + l e_z x R^T (0, 0, -m g),   q' = q (0, omega)/2,   q (+) phi = q exp(phi)
//
// J = diag(0.5, 0.5, 0.2) kg m^2 about the tip, m l = 0.7 kg m, g = 9.81 m/s^2. Source: Goldstein, Classical Mechanics,
// section 5.7. The energy of its rotation and of its height is conserved.
#include <Eigen/Geometry>
#include <cmath>

#include <trammel/testing/problems.hpp>

namespace trammel::problems {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d J(0.5, 0.5, 0.2);       // [kg m^2]
constexpr double moment = 0.7 * 9.81;  // m g l [N m]

Quaterniond quaternion(const Vec& q) {
  return {q[0], q[1], q[2], q[3]};
}
Vec numbers(const Quaterniond& p) {
  return Eigen::Vector4d(p.w(), p.x(), p.y(), p.z());
}

Vec retract(const Vec& q, const Vec& dq) {
  const double angle = dq.norm(), s = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5;
  return numbers(quaternion(q) * Quaterniond(std::cos(angle / 2), s * dq[0], s * dq[1], s * dq[2]));
}

Vec difference(const Vec& q1, const Vec& q0) {
  Quaterniond d = quaternion(q0).conjugate() * quaternion(q1);
  if (d.w() < 0) d.coeffs() *= -1;
  const double s = d.vec().norm();
  return d.vec() * (s > 1e-12 ? 2 * std::atan2(s, d.w()) / s : 2);
}

}  // namespace

Problem heavy_top(double spin) {
  Problem p{"heavy_top", "J omega' = -omega x J omega + l e_z x R^T (0, 0, -m g)", "Goldstein, section 5.7"};
  p.until = 0.5;
  p.closed_form = false;
  p.M = J.asDiagonal();
  p.force = [](double, const Vec& q, const Vec& v) -> Vec {
    const Vector3d omega = v, L = J.cwiseProduct(omega), down = quaternion(q).conjugate() * Vector3d(0, 0, -moment);
    return L.cross(omega) + Vector3d::UnitZ().cross(down);
  };
  p.exact = [spin](double, Vec& q, Vec& v) {
    q = Eigen::Vector4d(std::cos(0.3), std::sin(0.3), 0, 0);
    v = Vector3d(0.5, -1, spin);
  };
  p.energy = {moment, [](const State& s) {
                return s.v.dot(J.cwiseProduct(s.v)) / 2 + moment * (quaternion(s.q) * Vector3d::UnitZ()).z();
              }};
  p.manifold = {.rate = [](const Vec& q, const Vec& v) -> Vec {
                  return numbers(quaternion(q) * Quaterniond(0, v[0] / 2, v[1] / 2, v[2] / 2));
                },
                .normalise = [](const Vec& q) -> Vec { return q.normalized(); },
                .retract = retract,
                .difference = difference};
  return p;
}

}  // namespace trammel::problems
