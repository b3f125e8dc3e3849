#include "model/coordinates.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace trammel {

Coordinates Coordinates::flat(int n) {
  return Coordinates().then_flat(n);
}

Coordinates& Coordinates::then_flat(int n) {
  if (n > 0) parts_.push_back({Kind::flat, n, n});
  return *this;
}

Coordinates& Coordinates::then_rotation() {
  parts_.push_back({Kind::rotation, 4, 3});
  return *this;
}

int Coordinates::nq() const {
  int n = 0;
  for (const Part& part : parts_) n += part.nq;
  return n;
}

int Coordinates::nv() const {
  int n = 0;
  for (const Part& part : parts_) n += part.nv;
  return n;
}

namespace model {

namespace {

// [rad] Below it the next term of the series of sin(x/2)/x, x^4/3840, is less than round-off.
constexpr double small_angle = 1e-4;
// Sine of half an angle below which arcsin(s)/s = 1 + s^2/6 differs from 1 by less than round-off.
constexpr double small_sine = 1e-8;

// Unit quaternions (w, x, y, z), world from body; omega and increments in body axes.
Eigen::Quaterniond quaternion(const double* q) {
  return {q[0], q[1], q[2], q[3]};
}

void store(const Eigen::Quaterniond& p, double* q) {
  q[0] = p.w(), q[1] = p.x(), q[2] = p.y(), q[3] = p.z();
}

// exp of a rotation vector; the series keeps full accuracy through zero.
Eigen::Quaterniond exponential(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const double half = angle < small_angle ? 0.5 - angle * angle / 48 : std::sin(angle / 2) / angle;
  const Eigen::Vector3d xyz = half * phi;
  return {std::cos(angle / 2), xyz.x(), xyz.y(), xyz.z()};
}

// Its inverse; of p and -p, the shorter rotation.
Eigen::Vector3d logarithm(Eigen::Quaterniond p) {
  if (p.w() < 0) p.coeffs() = -p.coeffs();
  const double sine = p.vec().norm();
  const double factor = sine < small_sine ? 2.0 : 2 * std::atan2(sine, p.w()) / sine;
  return factor * p.vec();
}

}  // namespace

void rate(const Coordinates::Part& part, const double* q, const double* v, double* q_dot) {
  if (part.kind == Coordinates::Kind::flat) {
    std::copy(v, v + part.nv, q_dot);
    return;
  }
  const Eigen::Quaterniond half_omega(0, v[0] / 2, v[1] / 2, v[2] / 2);
  store(quaternion(q) * half_omega, q_dot);
}

void normalise(const Coordinates::Part& part, double* q) {
  if (part.kind == Coordinates::Kind::rotation) store(quaternion(q).normalized(), q);
}

void retract(const Coordinates::Part& part, const double* q, const double* dq, double* q_new) {
  if (part.kind == Coordinates::Kind::flat) {
    for (int i = 0; i < part.nq; ++i) q_new[i] = q[i] + dq[i];
    return;
  }
  store((quaternion(q) * exponential({dq[0], dq[1], dq[2]})).normalized(), q_new);
}

void difference(const Coordinates::Part& part, const double* q1, const double* q0, double* dq) {
  if (part.kind == Coordinates::Kind::flat) {
    for (int i = 0; i < part.nq; ++i) dq[i] = q1[i] - q0[i];
    return;
  }
  Eigen::Map<Eigen::Vector3d>{dq} = logarithm(quaternion(q0).conjugate() * quaternion(q1));
}

}  // namespace model
}  // namespace trammel
