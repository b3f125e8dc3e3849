// A planar rotary spring and damper between two markers' frames.
//
//     M = k (phi - angle) + c phi'        phi = theta_B - theta_A, counting full turns
//     U = k (phi - angle)^2 / 2           dissipated power c phi'^2
//
// A is turned with +M and B with -M [N m], counter-clockwise positive.
#include <trammel/force.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct TorsionalSpring : Force {
  double stiffness = 0, damping = 0, angle = 0;

  void prepare(const World& world) override {
    if (world.space != Space::planar)
      throw ParameterError("type", "torsional_spring is planar; this scene is spatial, where it would need an axis");
    if (stiffness == 0 && damping == 0) throw ParameterError("stiffness", "give stiffness, damping or both");
  }

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const double moment = stiffness * twist(A, B) + damping * (B.V(2) - A.V(2));
    on_A(2) += moment;
    on_B(2) -= moment;
  }

  double potential(double, const Motion& A, const Motion& B) const override {
    return 0.5 * stiffness * twist(A, B) * twist(A, B);
  }

  Power power(double, const Motion& A, const Motion& B) const override {
    const double phi_dot = B.V(2) - A.V(2);
    return {.dissipated = damping * phi_dot * phi_dot};
  }

 private:
  double twist(const Motion& A, const Motion& B) const { return B.angle - A.angle - angle; }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<TorsionalSpring>("torsional_spring",
                                               "planar rotary spring and damper between two markers")
                   .source("Hooke's law with viscous damping in the relative angle")
                   .parameter("stiffness", &TorsionalSpring::stiffness, {.unit = "N m/rad", .min = 0, .doc = "k"})
                   .parameter("damping", &TorsionalSpring::damping, {.unit = "N m s/rad", .min = 0, .doc = "c"})
                   .parameter("angle", &TorsionalSpring::angle, {.unit = "rad", .doc = "theta_B - theta_A at rest"}))
