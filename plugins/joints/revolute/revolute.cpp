// A hinge: the two markers coincide and, in space, have a common axis; the angle is free or follows a law of time.
//
//     g = x_B - x_A                                     2 rows planar, 3 spatial
//     e_2 . n_B, e_3 . n_B                              spatial: n_B perpendicular to two directions of A
//     the angle of B against A minus angle(t)           with "angle": an ideal rotary drive
//
// lambda [N] of the first rows: the joint pushes B with -lambda and A with +lambda, world axes.
//
// With friction it is a journal bearing of radius r (joint_friction.hpp); the slip is r times the relative rotation. F,
// M: its force and moment on B; n: its axis, L: its length in space
//
//     without L    |F across n|                                              in the plane |F|: torque mu r |F|
//     with L       |p_1| + |p_2|,   p = F across n / 2 +- M x n / L          at both ends of the journal
//     in space     plus |F . n|: thrust on a shoulder with the same radius
#include <cmath>
#include <numbers>

#include <trammel/joint_friction.hpp>
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

#include "../bearing_loads.hpp"

namespace {

using namespace trammel;
using Eigen::Vector3d;

struct Revolute : RowJoint, BearingJoint {
  std::optional<Vec3> axis, axis_b;
  std::optional<TimeFunction> angle;
  std::optional<double> radius, length;  // [m]

  JointRows made_of(const World& world) const override {
    const Vector3d n_A = spatial_axis(world, axis, "axis"), n_B = spatial_axis(world, axis_b, "axis_b", n_A);
    JointRows rows(world.space);
    rows.same_point().parallel(n_A, n_B);
    if (angle) rows.angle(n_A, smallest_rotation(n_B, n_A), *angle);
    return rows;
  }

  void prepare(const World& world) override {
    RowJoint::prepare(world);
    if (length && world.space == Space::planar)
      throw ParameterError("length", "this scene is planar, where no moment acts across the axis; remove it");
    planar_ = world.space == Space::planar;
    n_ = spatial_axis(world, axis, "axis");
    e_A_ = n_.unitOrthogonal();
    e_B_ = smallest_rotation(n_, spatial_axis(world, axis_b, "axis_b", n_)) * e_A_;
  }

  void check_bearings(const World&) const override {
    if (!radius) throw ParameterError("radius", "friction turns about a journal: give its radius [m]");
  }
  bool driven() const override { return angle.has_value(); }

  void slip_row(double, const Motion& A, const Motion& B, Rows& row) const override {
    const double r = *radius;
    if (A.x.size() == 2) {
      row.g(0) = r * (B.angle - A.angle);
      row.H_A(0, 2) = -r, row.H_B(0, 2) = r;
      return;
    }
    const Vector3d n = A.R * n_, e = A.R * e_A_, e_B = B.R * e_B_;
    const Vector3d omega_A = A.V.tail<3>(), omega_B = B.V.tail<3>();
    row.g(0) = r * std::atan2(n.cross(e).dot(e_B), e.dot(e_B));
    row.H_A.row(0).tail<3>() = -r * n.transpose();
    row.H_B.row(0).tail<3>() = r * n.transpose();
    row.gamma(0) = -r * omega_A.cross(n).dot(omega_B - omega_A);
  }

  // In space the angle is determined up to full turns.
  double slid(double from, double to) const override {
    return planar_ ? to - from : std::remainder(to - from, 2 * std::numbers::pi * *radius);
  }

  void bearings(double, const Motion& A, const Motion&, Bearings& at) const override {
    if (A.x.size() == 2) {
      at.C.middleRows(at.add(2), 2).leftCols<2>().setIdentity();
      return;
    }
    const Vector3d n = A.R * n_;
    AcrossAxis::in_space(n).bear(length, at);
    at.C.row(at.add(1)).head<3>() = n.transpose();
  }

 private:
  bool planar_ = true;
  Vector3d n_, e_A_, e_B_;  // the axis and a direction across it in A's axes, and that direction in B's at angle 0
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Revolute>("revolute", "hinge: two markers share one point, and in space one axis")
        .source("A. A. Shabana, Dynamics of Multibody Systems: revolute joint")
        .parameter("axis", &Revolute::axis, {.doc = "spatial: direction in marker A's axes; [0, 0, 1] if left out"})
        .parameter("axis_b", &Revolute::axis_b,
                   {.doc = "spatial: the same direction in marker B's axes; the numbers of axis if left out"})
        .parameter("angle", &Revolute::angle,
                   {.unit = "rad",
                    .doc = "of B against A, held to it: a number or a law of t; free if left out",
                    .derivatives = 2})
        .parameter("radius", &Revolute::radius,
                   {.unit = "m",
                    .min = 0,
                    .above_min = true,
                    .doc = "for friction: of the journal, on which it acts; required with it"})
        .parameter(
            "length", &Revolute::length,
            {.unit = "m",
             .min = 0,
             .above_min = true,
             .doc = "for friction, spatial: of the journal; a moment across the axis presses with M/length at both of "
                    "its ends; if left out it does not rub"}))
