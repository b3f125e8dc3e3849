// Two gears in mesh, given by their numbers of teeth. Their bodies turn about axes fixed in the world, in other joints.
//
//     g = wrap(z_A theta_A +- z_B theta_B - phase) / z_B = 0   (1 row)       + external, - internal mesh
//
// theta [rad] is the angle of the marker's frame about the axis n against the world's axes. Multiples of a tooth are
// removed (wrap into [-pi, pi]), so that turns need not be counted. With h of axis_angle.hpp
//     theta' = h . omega,    theta'' = h . alpha + h' . omega
// lambda [N m] on B. In the plane theta is the marker's angle and n the plane's normal.
#include <cmath>
#include <numbers>

#include <trammel/axis_angle.hpp>
#include <trammel/joint.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector3d;

// The world's frame, at rest.
Motion world_frame(Space space) {
  Motion m;
  m.x = Vec3::Zero(dimension(space));
  m.R = Mat3::Identity(dimension(space), dimension(space));
  m.V = Vec6::Zero(twist_size(space));
  return m;
}

struct Gear : Joint, ReactionTangent, NeedsOrientation {
  std::vector<double> teeth;
  bool internal = false;
  double phase = 0;
  std::optional<Vec3> axis, axis_b;

  void prepare(const World& world) override {
    world_ = world_frame(world.space);
    if (teeth.size() != 2 || teeth[0] != std::round(teeth[0]) || teeth[1] != std::round(teeth[1]))
      throw ParameterError("teeth", "expected two whole numbers, the teeth of A and of B");
    z_A_ = teeth[0], z_B_ = internal ? -teeth[1] : teeth[1];
    if (world.space == Space::planar && (axis || axis_b))
      throw ParameterError(axis ? "axis" : "axis_b", "this scene is planar, where gears turn about the plane's normal");
    const Vector3d n = axis ? Vector3d(*axis) : Vector3d::UnitZ(), n_b = axis_b ? Vector3d(*axis_b) : n;
    for (const auto& [name, value] : {std::pair{"axis", n}, std::pair{"axis_b", n_b}})
      if (!(value.stableNorm() > 0)) throw ParameterError(name, "the axis is zero; expected a direction");
    A_ = AxisAngle(n.stableNormalized()), B_ = AxisAngle(n_b.stableNormalized());
  }

  int row_count(Space) const override { return 1; }
  bool needs_orientation(int) const override { return true; }

  void rows(double, const Motion& A, const Motion& B, Rows& rows) const override {
    const double c_A = z_A_ / teeth[1], c_B = z_B_ / teeth[1];
    rows.g(0) = std::remainder(z_A_ * A_.angle(world_, A) + z_B_ * B_.angle(world_, B) - phase, 2 * std::numbers::pi) /
                teeth[1];
    rows.H_A.row(0).tail(A.V.size() - A.x.size()) = c_A * A_.gradient(world_, A).transpose();
    rows.H_B.row(0).tail(B.V.size() - B.x.size()) = c_B * B_.gradient(world_, B).transpose();
    rows.gamma(0) = -c_A * bias(A_, A) - c_B * bias(B_, B);
  }

  void add_reaction_tangent(double, const Motion& A, const Motion& B, const Vec6& lambda,
                            PairTangent& K) const override {
    if (A.x.size() == 2) return;
    K.AA.bottomRightCorner<3, 3>() += lambda(0) * z_A_ / teeth[1] * A_.gradient_by_turn(world_, A);
    K.BB.bottomRightCorner<3, 3>() += lambda(0) * z_B_ / teeth[1] * B_.gradient_by_turn(world_, B);
  }

 private:
  // h' . omega
  double bias(const AxisAngle& theta, const Motion& m) const {
    if (m.x.size() == 2) return 0;
    const Vector3d omega = m.V.tail<3>();
    return omega.dot(theta.gradient_by_turn(world_, m) * omega);
  }

  Motion world_;
  double z_A_ = 1, z_B_ = 1;
  AxisAngle A_, B_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<Gear>("gear", "two meshing gears on axes fixed in the world, by their teeth")
                   .source("kinematics of rolling pitch circles")
                   .parameter("teeth", &Gear::teeth,
                              {.min = 1, .max = 1e6, .required = true, .doc = "whole numbers of teeth of A and of B"})
                   .parameter("internal", &Gear::internal, {.doc = "one is a ring: both turn the same way"})
                   .parameter("phase", &Gear::phase, {.unit = "rad", .doc = "z_A theta_A +- z_B theta_B while in mesh"})
                   .parameter("axis", &Gear::axis, {.doc = "spatial: of A, in world axes; [0, 0, 1] if left out"})
                   .parameter("axis_b", &Gear::axis_b, {.doc = "spatial: of B, in world axes; axis if left out"}))
