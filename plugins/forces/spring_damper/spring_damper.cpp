// A straight spring and damper between two markers, planar or spatial.
//
//     F = k (l - L) + c l'        tension [N] along u = d / l,  d = x_B - x_A,  l = |d|,  l' = u . d'
//     U = k (l - L)^2 / 2         dissipated power c l'^2
//
// The force is +F u on A and -F u on B. If the markers coincide (l = 0), u is undefined: a spring of rest length 0
// exerts no force there, any other throws OutsideDomain.
#include <trammel/force.hpp>
#include <trammel/outside_domain.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct SpringDamper : Force, WrenchTangent {
  double stiffness = 0, damping = 0;
  std::optional<double> length;  // L

  void prepare(const World&) override {
    if (stiffness > 0 && !length)
      throw ParameterError("length", "missing; a spring with stiffness needs its rest length");
    if (stiffness == 0 && damping == 0) throw ParameterError("stiffness", "give stiffness, damping or both");
    rest_ = length.value_or(0);
  }

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const Line line = between(A, B);
    if (line.l == 0 && stiffness > 0 && rest_ > 0)
      throw OutsideDomain("its markers coincide, so a spring of rest length > 0 has no direction");
    const double tension = stiffness * (line.l - rest_) + damping * line.l_dot;
    on_A.head(line.u.size()) += tension * line.u;
    on_B.head(line.u.size()) -= tension * line.u;
  }

  double potential(double, const Motion& A, const Motion& B) const override {
    const double stretch = between(A, B).l - rest_;
    return 0.5 * stiffness * stretch * stretch;
  }

  Power power(double, const Motion& A, const Motion& B) const override {
    const double l_dot = between(A, B).l_dot;
    return {.dissipated = damping * l_dot * l_dot};
  }

  // By d:  dF/dl u u^T + F/l (1 - u u^T) + c u (dl'/dd)^T,   dl'/dd = (d' - l' u)/l;   by d':  c u u^T.
  void add_wrench_tangent(double, const Motion& A, const Motion& B, PairTangent& K, PairTangent& D) const override {
    const Line line = between(A, B);
    const auto dim = line.u.size();
    const Mat3 one = Mat3::Identity(dim, dim), along = line.u * line.u.transpose();
    if (line.l == 0) {
      if (rest_ == 0) add_by_distance(stiffness * one, K);
      return;
    }
    const Vec3 turning = (B.V.head(dim) - A.V.head(dim) - line.l_dot * line.u) / line.l;
    const double pull = (stiffness * (line.l - rest_) + damping * line.l_dot) / line.l;
    add_by_distance(stiffness * along + pull * (one - along) + damping * line.u * turning.transpose(), K);
    add_by_distance(damping * along, D);
  }

 private:
  struct Line {
    Vec3 u;
    double l, l_dot;
  };
  static Line between(const Motion& A, const Motion& B) {
    const auto dim = A.x.size();
    const Vec3 d = B.x - A.x;
    const double l = d.stableNorm();  // of 1e-300 m, too
    if (l == 0) return {Vec3::Zero(dim), 0, 0};
    const Vec3 u = d / l;
    return {u, l, u.dot(B.V.head(dim) - A.V.head(dim))};
  }

  double rest_ = 0;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<SpringDamper>("spring_damper", "straight spring and damper between two markers")
                   .source("Hooke's law with viscous damping along the line of the markers")
                   .parameter("stiffness", &SpringDamper::stiffness, {.unit = "N/m", .min = 0, .doc = "k"})
                   .parameter("damping", &SpringDamper::damping, {.unit = "N s/m", .min = 0, .doc = "c"})
                   .parameter("length", &SpringDamper::length,
                              {.unit = "m", .min = 0, .doc = "where it is at rest; needed with stiffness"}))
