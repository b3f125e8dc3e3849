// A spring through the markers' common point, with a damper along their line, planar or spatial, to change:
//
//     F = (k l + c l') u,   d = x_B - x_A,  l = |d|,  u = d/l,  l' = u . d'        on A; -F on B
//     U = k l^2/2,          dissipated power c l'^2
//
// Forces along the line are equal and opposite in moment, too; damping of d' across it would not be.
#include <cmath>

#include <trammel/force.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct MyForce final : Force {
  double stiffness = 10, damping = 1;

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const Line line = between(A, B);
    const Vec3 F = (stiffness * line.l + damping * line.rate) * line.u;
    on_A.head(F.size()) += F;
    on_B.head(F.size()) -= F;
  }
  double potential(double, const Motion& A, const Motion& B) const override {
    return stiffness * (B.x - A.x).squaredNorm() / 2;
  }
  Power power(double, const Motion& A, const Motion& B) const override {
    return {.dissipated = damping * std::pow(between(A, B).rate, 2)};
  }

 private:
  struct Line {
    double l, rate;
    Vec3 u;
  };
  static Line between(const Motion& A, const Motion& B) {
    const Vec3 d = B.x - A.x;
    const double l = d.norm();
    const Vec3 u = l > 0 ? Vec3(d / l) : Vec3(0 * d);  // where the markers meet the spring is at rest
    return {l, u.dot(B.V.head(d.size()) - A.V.head(d.size())), u};
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<MyForce>("my_force", "spring and damper between two markers, to change")
                   .source("Hooke's law with viscous damping")
                   .parameter("stiffness", &MyForce::stiffness, {.unit = "N/m", .min = 0})
                   .parameter("damping", &MyForce::damping, {.unit = "N s/m", .min = 0}))
