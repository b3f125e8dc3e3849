// A spatial rigid body about its fixed centre, for tests of the checks on rotations, correct unless a fault is set.
//
//     J omega' = -omega x J omega + r x R^T F,   F a weight of 3 N along -z at r in body axes; omega in body axes
#pragma once

#include <Eigen/Geometry>

#include <trammel/body.hpp>

namespace trammel::test {

enum class TopDefect { none, starts_off_the_manifold, reads_the_sign, velocity_in_body_axes };

class FreeTop final : public Body {
 public:
  explicit FreeTop(TopDefect defect) : defect_(defect) {}

  Coordinates coordinates() const override { return Coordinates().then_rotation(); }
  void initial(Out q, Out v) const override {
    q = Eigen::Vector4d(0.5, 0.5, -0.5, 0.5) * (defect_ == TopDefect::starts_off_the_manifold ? 1.01 : 1);
    v = Eigen::Vector3d(0.2, 0, 3);
  }
  void mass(double, In, Matrix& M) const override {
    for (int i = 0; i < 3; ++i) M.add(i, i, J(i));
  }
  bool mass_is_constant() const override { return true; }
  void force(double, In q, In v, Out f) const override {
    const Eigen::Vector3d omega = v, spin = J.cwiseProduct(omega);
    f += spin.cross(omega) + r.cross(rotation(q).transpose() * weight);
    if (defect_ == TopDefect::reads_the_sign) f(0) += q(0);
  }
  Energy energy(double, In q, In v) const override {
    return {.kinetic = v.dot(J.cwiseProduct(v)) / 2, .potential = -weight.dot(rotation(q) * r)};
  }
  std::span<const std::string> markers() const override { return names_; }
  void motion(int, double, In q, In v, Motion& motion) const override {
    const Eigen::Matrix3d R = rotation(q);
    const Eigen::Vector3d x = R * r, omega = v;
    const Eigen::Matrix3d arm{{0, x.z(), -x.y()}, {-x.z(), 0, x.x()}, {x.y(), -x.x(), 0}};  // omega x x = arm omega
    motion.x = x;
    motion.R = R;
    motion.dofs.assign({0, 1, 2});
    motion.J.resize(6, 3);
    motion.J.topRows<3>() = arm * R;
    motion.J.bottomRows<3>() = defect_ == TopDefect::velocity_in_body_axes ? Eigen::Matrix3d::Identity() : R;
    motion.V = motion.J * v;
    const Eigen::Vector3d w = R * omega;
    motion.bias = Vec6::Zero(6);
    motion.bias.head<3>() = w.cross(w.cross(x));
  }

 private:
  static Eigen::Matrix3d rotation(In q) { return Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix(); }

  TopDefect defect_;
  std::vector<std::string> names_ = {"tip"};
  const Eigen::Vector3d J{0.5, 0.4, 0.2}, r{0, 0.1, 0.7}, weight{0, 0, -3};
};

}  // namespace trammel::test
