// A spring and damper between two markers, by components in world axes, planar or spatial, to change:
//
//     F = k d + c d',   d = x_B - x_A        on A; -F on B
//     U = k d . d/2,    dissipated power c d' . d'
#include <trammel/force.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct MyForce final : Force {
  double stiffness = 10, damping = 1;

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const Vec3 F = stiffness * (B.x - A.x) + damping * rate(A, B);
    on_A.head(F.size()) += F;
    on_B.head(F.size()) -= F;
  }
  double potential(double, const Motion& A, const Motion& B) const override {
    return stiffness * (B.x - A.x).squaredNorm() / 2;
  }
  Power power(double, const Motion& A, const Motion& B) const override {
    return {.dissipated = damping * rate(A, B).squaredNorm()};
  }

 private:
  static Vec3 rate(const Motion& A, const Motion& B) { return B.V.head(B.x.size()) - A.V.head(A.x.size()); }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<MyForce>("my_force", "spring and damper between two markers, to change")
                   .source("Hooke's law with viscous damping")
                   .parameter("stiffness", &MyForce::stiffness, {.unit = "N/m", .min = 0})
                   .parameter("damping", &MyForce::damping, {.unit = "N s/m", .min = 0}))
