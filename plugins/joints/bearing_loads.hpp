// The loads p of bearings on an axis s by the force F and the moment M across it:
//
//     one bearing    p = F across s                              self-aligning: M causes no friction
//     two, L apart   p = F across s / 2 +- M x s / L             at the ends of a guide or a journal of length L
//
// in the directions e across s: (M x s) . e = M . (s x e).
#pragma once

#include <optional>

#include <Eigen/Geometry>

#include <trammel/joint_friction.hpp>

namespace trammel {

// Rows that multiply the wrench (F; M), one for each direction across: F . e, and M . (s x e).
struct AcrossAxis {
  Mat6 force, couple;

  static AcrossAxis in_the_plane(const Eigen::Vector2d& s) {
    AcrossAxis across{Mat6::Zero(1, 3), Mat6::Zero(1, 3)};
    across.force.leftCols<2>() << -s.y(), s.x();
    across.couple(0, 2) = 1;
    return across;
  }
  static AcrossAxis in_space(const Eigen::Vector3d& s) {
    AcrossAxis across{Mat6::Zero(2, 6), Mat6::Zero(2, 6)};
    const Eigen::Vector3d e = s.unitOrthogonal(), f = s.cross(e);
    across.force.leftCols<3>() << e.transpose(), f.transpose();
    across.couple.rightCols<3>() << f.transpose(), -e.transpose();
    return across;
  }

  void bear(std::optional<double> length, Bearings& at) const {
    if (!length) return add(force, at);
    add(force / 2 + couple / *length, at);
    add(force / 2 - couple / *length, at);
  }

 private:
  static void add(const Mat6& load, Bearings& at) {
    const auto n = load.rows();
    at.C.middleRows(at.add(int(n)), n) = load;
  }
};

}  // namespace trammel
