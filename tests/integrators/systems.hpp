// Systems with known answers for the integrators' tests.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <trammel/integrator.hpp>

#include "dense_system.hpp"

namespace trammel::test {

// q_i'' = -omega_i^2 q_i - 2 mu q_i'.
class Oscillators final : public DenseSystem {
 public:
  explicit Oscillators(std::vector<double> omega, double mu = 0)
      : omega_(Eigen::Map<Vec>(omega.data(), Eigen::Index(omega.size()))), mu_(mu) {}
  Sizes sizes() const override { return {int(omega_.size()), int(omega_.size()), 0}; }

  // From q = 1, v = 0.
  State start() {
    State s{0, Vec::Ones(omega_.size()), Vec::Zero(omega_.size()), {}, {}};
    move_to(s.t, s.q, s.v);
    accelerate({}, s.a, s.lambda);
    return s;
  }
  State exact(double t) const {
    State s{t, Vec(omega_.size()), Vec(omega_.size()), Vec(0), Vec(0)};
    for (Eigen::Index i = 0; i < omega_.size(); ++i) {
      const double w = std::sqrt(omega_[i] * omega_[i] - mu_ * mu_), e = std::exp(-mu_ * t);
      s.q[i] = e * (std::cos(w * t) + mu_ / w * std::sin(w * t));
      s.v[i] = -e * (w + mu_ * mu_ / w) * std::sin(w * t);
    }
    return s;
  }

 protected:
  Mat mass() const override { return Mat::Identity(omega_.size(), omega_.size()); }
  Vec force(double, const Vec& q, const Vec& v) const override {
    return -(omega_.array().square() * q.array()).matrix() - 2 * mu_ * v;
  }
  Mat tangent(double c_d, double c_k, const Vec&, const Vec&) const override {
    return (c_k * omega_.array().square() + c_d * 2 * mu_).matrix().asDiagonal();
  }

 private:
  Vec omega_;
  double mu_;
};

// A point of unit mass on a rod of unit length in gravity, in its two Cartesian coordinates:
//     g = (x^2 + y^2 - 1)/2,  G = (x, y),  lambda = (f . x + |v|^2)/|x|^2
// `rod` may be taken off, `wind` swings the pivot: g = ((x - wind sin 3t)^2 + y^2 - 1)/2.
class Pendulum final : public DenseSystem {
 public:
  bool rod = true;
  double wind = 0;
  double stiff = 0;  // [1/s^2] of a second way to hold the length: a force -stiff (r - 1) along the rod

  Sizes sizes() const override { return {2, 2, rod ? 1 : 0}; }
  State at(double t, double x, double y, double vx, double vy) {
    State s{t, Eigen::Vector2d(x, y), Eigen::Vector2d(vx, vy), {}, {}};
    move_to(s.t, s.q, s.v);
    accelerate({}, s.a, s.lambda);
    return s;
  }
  State start() { return at(0, std::sin(1.0), -std::cos(1.0), 0.4 * std::cos(1.0) + 3 * wind, 0.4 * std::sin(1.0)); }
  static double energy(const State& s) { return 0.5 * s.v.squaredNorm() + 9.81 * s.q[1]; }

 protected:
  Mat mass() const override { return Mat::Identity(2, 2); }
  Vec force(double, const Vec& q, const Vec&) const override {
    Vec f = Eigen::Vector2d(0, -9.81);
    if (stiff > 0) f -= stiff * (q.norm() - 1) * q.normalized();
    return f;
  }
  void rows(double t, const Vec& q, const Vec& v, Rows& r) const override {
    if (!rod) return DenseSystem::rows(t, q, v, r);
    const double p = wind * std::sin(3 * t), p_t = 3 * wind * std::cos(3 * t), p_tt = -9 * p;
    const Eigen::Vector2d d(q[0] - p, q[1]), u(v[0] - p_t, v[1]);
    r.G = d.transpose();
    r.g = Vec::Constant(1, (d.squaredNorm() - 1) / 2);
    r.g_t = Vec::Constant(1, -d[0] * p_t);
    r.gamma = Vec::Constant(1, -u.squaredNorm() + d[0] * p_tt);
  }
};

// A heavy symmetric top on its tip: q a unit quaternion (w, x, y, z), v the angular velocity in body axes.
//     J omega' = -omega x J omega + r x R^T (0, 0, -g m)
class Top final : public DenseSystem {
 public:
  Sizes sizes() const override { return {4, 3, 0}; }
  State start() {
    State s{0, Eigen::Vector4d(std::cos(0.3), std::sin(0.3), 0, 0), Eigen::Vector3d(0.5, -1, 20), {}, {}};
    move_to(s.t, s.q, s.v);
    accelerate({}, s.a, s.lambda);
    return s;
  }
  void rate(const Vec& q, const Vec& v, Vec& q_dot) const override {
    q_dot = product(q, Eigen::Vector4d(0, v[0], v[1], v[2])) / 2;
  }
  void normalise(Vec& q) const override { q.normalize(); }
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override {
    const double angle = dq.norm(), s = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5;
    q_new = product(q, Eigen::Vector4d(std::cos(angle / 2), s * dq[0], s * dq[1], s * dq[2]));
  }
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override {
    Eigen::Vector4d d = product(Eigen::Vector4d(q0[0], -q0[1], -q0[2], -q0[3]), q1);
    if (d[0] < 0) d = -d;
    const double s = d.tail<3>().norm();
    dq = d.tail<3>() * (s > 1e-12 ? 2 * std::atan2(s, d[0]) / s : 2);
  }

 protected:
  Mat mass() const override { return Eigen::Vector3d(0.5, 0.5, 0.2).asDiagonal(); }
  Vec force(double, const Vec& q, const Vec& v) const override {
    const Eigen::Vector3d omega = v, J(0.5, 0.5, 0.2);
    const Eigen::Quaterniond R(q[0], q[1], q[2], q[3]);
    const Eigen::Vector3d weight = R.conjugate() * Eigen::Vector3d(0, 0, -9.81), spin = J.cwiseProduct(omega);
    return -omega.cross(spin) + Eigen::Vector3d(0, 0, 0.7).cross(weight);
  }

 private:
  static Vec product(const Vec& a, const Vec& b) {
    const Eigen::Quaterniond c =
        Eigen::Quaterniond(a[0], a[1], a[2], a[3]) * Eigen::Quaterniond(b[0], b[1], b[2], b[3]);
    return Eigen::Vector4d(c.w(), c.x(), c.y(), c.z());
  }
};

// Nothing moves: nv = 0.
class Nothing final : public DenseSystem {
 public:
  Sizes sizes() const override { return {}; }

 protected:
  Mat mass() const override { return Mat(0, 0); }
  Vec force(double, const Vec&, const Vec&) const override { return Vec(0); }
};

}  // namespace trammel::test
