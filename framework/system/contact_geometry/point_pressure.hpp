// The force of a contact law and its friction at one point of a surface, with its derivatives.
//
//     F = w (N n - ratio(|s|) N s/|s|)                       on A; n of length 1 from B to A, s slip of A over B
//     dF = w (n - ratio e)(N_gap dgap + N_rate drate) + w N dn - w N (ratio/|s| (1 - e e^T) + ratio' e e^T) ds
//     e = s/|s|
//
// w: the law's weight of the point [m^2], N: its normal pressure there [Pa]; or [1] and [N].
#pragma once

#include "model/model.hpp"

namespace trammel::model {

struct PressedPoint {
  using V3 = Eigen::Vector3d;
  double gap = 0, rate = 0, weight = 0, N = 0;
  V3 n = V3::Zero(), slip = V3::Zero(), F = V3::Zero();
};

// Sums over all points of a contact.
struct PressureSums {
  double normal = 0;     // [N]
  double potential = 0;  // [J]
  double damping = 0;    // [W] lost along the normals
  double friction = 0;   // [W] lost in sliding
};

// Derivatives of a point's gap, gap rate, normal and slip by some variables, one column each.
template <int variables>
struct PointChange {
  Eigen::Matrix<double, 1, variables> gap, rate;
  Eigen::Matrix<double, 3, variables> n, slip;
};

// Derivatives by the point's position, the marker's position and the marker's rotation, three columns each.
using MarkerPointChange = PointChange<9>;
using M39 = Eigen::Matrix<double, 3, 9>;
using M69 = Eigen::Matrix<double, 6, 9>;

class PointPressure {
 public:
  explicit PointPressure(const ContactEntry& entry)
      : force_(entry.force), by_points_(entry.surface->by_points), friction_(entry.surface->friction) {}

  // Fills weight, N and F of a point that represents `area`, and adds them to the sums.
  void ask(PressedPoint& at, double area, double approach_speed, PressureSums& sums) const {
    at.weight = by_points_->weight(area);
    at.N = force_->normal(at.gap, at.rate, approach_speed);
    at.F = at.N * at.n;
    if (const double slip = friction_ ? at.slip.norm() : 0; slip > 0) {
      at.F -= friction_->ratio(slip) * at.N / slip * at.slip;
      sums.friction += at.weight * friction_->ratio(slip) * at.N * slip;
    }
    at.F *= at.weight;
    sums.normal += at.weight * at.N;
    sums.potential += at.weight * force_->potential(at.gap);
    sums.damping -= at.weight * (at.N - force_->normal(at.gap, 0, approach_speed)) * at.rate;
  }

  template <int variables>
  Eigen::Matrix<double, 3, variables> change(const PressedPoint& at, double approach_speed,
                                             const PointChange<variables>& by) const {
    const auto [by_gap, by_rate] = force_->slope(at.gap, at.rate, approach_speed);
    const double w = at.weight;
    Eigen::Vector3d push = at.n;
    Eigen::Matrix3d by_slip = Eigen::Matrix3d::Zero();
    if (friction_) {
      const double slip = at.slip.norm(), ratio = friction_->ratio(slip), slope = friction_->slope(slip);
      const Eigen::Vector3d e = slip > 0 ? Eigen::Vector3d(at.slip / slip) : Eigen::Vector3d(Eigen::Vector3d::Zero());
      const double secant = slip > 0 ? ratio / slip : slope;
      push -= ratio * e;
      by_slip = -w * at.N * (secant * Eigen::Matrix3d::Identity() + (slope - secant) * e * e.transpose());
    }
    Eigen::Matrix<double, 3, variables> F = (w * push) * (by_gap * by.gap + by_rate * by.rate) + (w * at.N) * by.n;
    if (friction_) F += by_slip * by.slip;
    return F;
  }

 private:
  const ContactForce* force_;
  const ForceBySurfacePoints* by_points_;
  const SmoothFriction* friction_;
};

inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {  // cross_matrix(a) b = a x b
  return Eigen::Matrix3d{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
}

}  // namespace trammel::model
