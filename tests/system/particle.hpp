// A particle in the plane without any ability: the smallest body, so that every fallback of the assembly is exercised.
#pragma once

#include <memory>

#include "system/assembled_system.hpp"

namespace trammel::model::test {

class Particle final : public Body {
 public:
  Particle(double mass, Eigen::Vector2d x, Eigen::Vector2d v) : mass_(mass), x_(x), v_(v) {}
  Coordinates coordinates() const override { return Coordinates::flat(2); }
  void initial(Out q, Out v) const override { q = x_, v = v_; }
  void mass(double, In, Matrix& M) const override { M.add(0, 0, mass_), M.add(1, 1, mass_); }
  bool mass_is_constant() const override { return true; }
  void force(double, In, In, Out f) const override { f(1) -= 9.81 * mass_; }
  Energy energy(double, In q, In v) const override {
    return {.kinetic = mass_ * v.squaredNorm() / 2, .potential = 9.81 * mass_ * q(1)};
  }
  std::span<const std::string> markers() const override { return markers_; }
  void motion(int, double, In q, In v, Motion& m) const override {
    m.x = q;
    m.R.setIdentity(2, 2);
    m.V.setZero(3);
    m.V.head<2>() = v;
    m.bias.setZero(3);
    m.dofs = {0, 1};
    m.J.setZero(3, 2);
    m.J(0, 0) = m.J(1, 1) = 1;
  }

 private:
  double mass_;
  Eigen::Vector2d x_, v_;
  std::vector<std::string> markers_ = {"point"};
};

// Keeps |x_A - x_B| = length: g = (|d|^2 - L^2) / (2 L).
class Rod final : public Joint {
 public:
  explicit Rod(double length) : L_(length) {}
  int row_count(Space) const override { return 1; }
  void rows(double, const Motion& A, const Motion& B, Rows& rows) const override {
    const Eigen::Vector2d d = A.x - B.x, u = A.V.head<2>() - B.V.head<2>();
    rows.g(0) = (d.squaredNorm() - L_ * L_) / (2 * L_);
    rows.H_A.row(0).head<2>() = d.transpose() / L_;
    rows.H_B.row(0).head<2>() = -d.transpose() / L_;
    rows.gamma(0) = -u.squaredNorm() / L_;
  }

 private:
  double L_;
};

inline void add_particle(Model& model, std::string name, double mass, Eigen::Vector2d x, Eigen::Vector2d v) {
  model.bodies.emplace_back();
  model.bodies.back().name = std::move(name);
  model.bodies.back().body = std::make_unique<Particle>(mass, x, v);
}

inline void add_rod(Model& model, MarkerRef A, MarkerRef B, double length) {
  model.joints.emplace_back();
  model.joints.back().name = "rod";
  model.joints.back().joint = std::make_unique<Rod>(length);
  model.joints.back().markers = {A, B};
}

}  // namespace trammel::model::test
