// A rotary spring and damper between two markers' frames, about an axis of the first.
//
//     M = k (phi - angle) + c phi'        phi: angle of B against A about the axis, see axis_angle.hpp
//     U = k (phi - angle)^2 / 2           dissipated power c phi'^2
//
// The moment is +M h on A and -M h on B [N m], with h the gradient of phi, which is the axis itself in a hinge. phi
// includes full turns: in the plane phi = theta_B - theta_A; in space turns are counted from the start, where phi is
// within half a turn of the rest angle, or of 0 if the spring is preloaded by more (|angle| > pi).
#include <cmath>
#include <numbers>

#include <trammel/axis_angle.hpp>
#include <trammel/counts_turns.hpp>
#include <trammel/force.hpp>
#include <trammel/joint_rows.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct TorsionalSpring : Force, NeedsOrientation, CountsTurns {
  double stiffness = 0, damping = 0, angle = 0;
  std::optional<Vec3> axis;

  void prepare(const World& world) override {
    if (stiffness == 0 && damping == 0) throw ParameterError("stiffness", "give stiffness, damping or both");
    phi_ = AxisAngle(spatial_axis(world, axis, "axis"));
    counted_ = CountedAngle(std::abs(angle) <= std::numbers::pi ? angle : 0);
  }

  bool needs_orientation(int) const override { return true; }

  void follow(const Motion& A, const Motion& B) override { counted_.follow(phi_.angle(A, B)); }
  void archive(Archive& a) override { counted_.archive(a); }

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const double M = stiffness * twist(A, B) + damping * phi_.rate(A, B);
    const Vec3 h = phi_.gradient(A, B);
    const Eigen::Index first = on_A.size() - h.size();
    for (Eigen::Index k = 0; k < h.size(); ++k) on_A(first + k) += M * h(k), on_B(first + k) -= M * h(k);
  }

  double potential(double, const Motion& A, const Motion& B) const override {
    return 0.5 * stiffness * twist(A, B) * twist(A, B);
  }

  Power power(double, const Motion& A, const Motion& B) const override {
    const double phi_dot = phi_.rate(A, B);
    return {.dissipated = damping * phi_dot * phi_dot};
  }

 private:
  double twist(const Motion& A, const Motion& B) const {
    const double phi = phi_.angle(A, B);
    return (A.x.size() == 2 ? phi : counted_.near_last(phi)) - angle;
  }

  AxisAngle phi_;
  CountedAngle counted_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<TorsionalSpring>("torsional_spring", "rotary spring and damper between two markers")
                   .source("Hooke's law with viscous damping in the relative angle")
                   .parameter("stiffness", &TorsionalSpring::stiffness, {.unit = "N m/rad", .min = 0, .doc = "k"})
                   .parameter("damping", &TorsionalSpring::damping, {.unit = "N m s/rad", .min = 0, .doc = "c"})
                   .parameter("angle", &TorsionalSpring::angle,
                              {.unit = "rad", .doc = "of B against A at rest; full turns count"})
                   .parameter("axis", &TorsionalSpring::axis,
                              {.doc = "spatial: in marker A's axes; [0, 0, 1] if left out"}))
