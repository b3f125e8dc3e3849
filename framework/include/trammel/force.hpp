// A force element between two markers: springs, dampers, drives, loads.
#pragma once

#include <trammel/component.hpp>
#include <trammel/marker.hpp>

namespace trammel {

class Force : public Component {
 public:
  // Wrenches on A and B; zero on entry.
  virtual void wrench(double t, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const = 0;
  // Stored energy [J]; the conservative part of the wrench is minus its gradient.
  virtual double potential(double t, const Motion& A, const Motion& B) const = 0;
  // Power of the non-conservative part: d(potential)/dt + power of the wrenches = supplied - dissipated.
  virtual Power power(double t, const Motion& A, const Motion& B) const = 0;
};

// Ability of forces: the derivatives of both wrenches, exact. Without it the framework takes differences, whose steps
// presume that the force changes over the distance of the markers.
class WrenchTangent {
 public:
  virtual ~WrenchTangent();
  // Adds to K the derivatives by the markers' poses while V stays, and to D those by V. Blocks have the twists' size on
  // entry.
  virtual void add_wrench_tangent(double t, const Motion& A, const Motion& B, PairTangent& K, PairTangent& D) const = 0;
};
// Of a force F on A and -F on B that depends on d = x_B - x_A, or of its part by d': adds its derivative dF/dd.
inline void add_by_distance(const Mat3& dF_dd, PairTangent& K) {
  const auto n = dF_dd.rows();
  K.AA.topLeftCorner(n, n) -= dF_dd;
  K.AB.topLeftCorner(n, n) += dF_dd;
  K.BA.topLeftCorner(n, n) += dF_dd;
  K.BB.topLeftCorner(n, n) -= dF_dd;
}

}  // namespace trammel
