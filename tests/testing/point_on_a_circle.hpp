// A body with a row of its own for tests of the checks: a point of mass m on a growing circle, correct unless a fault
// is set.
//
//     q = (x, y), M = m 1, f = m g;   g_1 = (q . q - r(t)^2)/2,   G = q^T,   g_t = -r r',   gamma = -v . v + r'^2,   r
//     = 1 + t/5
#pragma once

#include <trammel/body.hpp>

namespace trammel::test {

enum class CircleDefect {
  none,
  rows_resized,
  gradient_of_twice_the_row,
  no_time_derivative,
  gamma_of_wrong_sign,
  no_reaction_derivative,
};

class PointOnACircle final : public Body, public Constrained {
 public:
  explicit PointOnACircle(CircleDefect defect) : defect_(defect) {}

  Coordinates coordinates() const override { return Coordinates::flat(2); }
  void initial(Out q, Out v) const override {
    q << 1, 0;
    v << growth, 1;
  }
  void mass(double, In, Matrix& M) const override { M.add(0, 0, m), M.add(1, 1, m); }
  bool mass_is_constant() const override { return true; }
  void force(double, In, In, Out f) const override { f(1) -= m * g; }
  Energy energy(double, In q, In v) const override {
    return {.kinetic = m * v.squaredNorm() / 2, .potential = m * g * q(1)};
  }

  std::span<const std::string> markers() const override { return names_; }
  void motion(int, double, In q, In v, Motion& motion) const override {
    motion.x = q;
    motion.R = Mat3::Identity(2, 2);
    motion.V = Eigen::Vector3d(v(0), v(1), 0);
    motion.bias = Vec6::Zero(3);
    motion.dofs = {0, 1};
    motion.J.setIdentity(3, 2);
  }

  int row_count() const override { return 1; }
  void own_rows(double t, In q, In v, BodyRows& rows) const override {
    const double r = 1 + growth * t;
    if (defect_ == CircleDefect::rows_resized) rows.resize(2, 2);
    rows.g(0) = (q.squaredNorm() - r * r) / 2;
    rows.G.row(0) = (defect_ == CircleDefect::gradient_of_twice_the_row ? 2 : 1) * q.transpose();
    rows.g_t(0) = defect_ == CircleDefect::no_time_derivative ? 0 : -r * growth;
    rows.gamma(0) = (defect_ == CircleDefect::gamma_of_wrong_sign ? 1 : -1) * v.squaredNorm() + growth * growth;
  }
  void add_own_rows_derivative(double, In, In lambda, double c, Matrix& S) const override {
    if (defect_ == CircleDefect::no_reaction_derivative) return;
    S.add(0, 0, c * lambda(0)), S.add(1, 1, c * lambda(0));
  }

 private:
  static constexpr double m = 1.3, g = 9.81, growth = 0.2;
  CircleDefect defect_;
  std::vector<std::string> names_ = {"point"};
};

}  // namespace trammel::test
