// The derivative of the generalised force of a few markers whose wrenches w are a function of their motions, exact or
// by differences of the poses and velocities: S += c_k d(J^T w)/dq + c_d d(J^T w)/dv. K includes the change of the
// markers' twists V = J(q) v with q at fixed v; without it, a damper between bodies that turn together would act on
// their common rotation.
#pragma once

#include <span>

#include "system/markers/marker_motions.hpp"

namespace trammel::model {

class MarkerWrenches {
 public:
  virtual ~MarkerWrenches() = default;
  // On entry `on` has one zero wrench for each marker.
  virtual void operator()(Motions markers, std::span<Wrench> on) const = 0;
  virtual bool depends_on_velocity() const = 0;
  // For two markers: adds the derivatives by poses and velocities to blocks of zeros. False: there are no exact ones.
  virtual bool exact_tangent(Motions, PairTangent& /*K*/, PairTangent& /*D*/) const { return false; }
};
void add_wrench_tangent(MarkerMotions& markers, std::span<const int> slots, double t, const Vec& q, const Vec& v,
                        const MarkerWrenches& wrenches, double c_k, double c_d, Matrix& S);

}  // namespace trammel::model
