// A slider: marker B moves along a line fixed in marker A's frame and does not turn against A.
//
//     e . d                              d = x_B - x_A; e: directions of A across its axis s (1 planar, 2 spatial)
//     orientation of B against A         planar theta_B - theta_A - angle; spatial R_B = R_A turn(s, angle) orientation
//     s . d - position(t)                with "position": an ideal linear drive
//
// The offset angle may be a law of time, too. lambda of the first rows [N] is the force across the guide.
//
// Friction acts at the guide (joint_friction.hpp). F, M: force and moment of the joint on B, about marker B; L: length
// of the guide, which is centred at marker B and moves with it; b: width between its two rails
//
//     without L    |F across s|
//     with L       |p_1| + |p_2|,   p = F across s / 2 +- M x s / L            at both ends of the guide
//     with b       2 |M . s| / b                                               in space: at both rails
#include <trammel/joint_friction.hpp>
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

#include "../bearing_loads.hpp"

namespace {

using namespace trammel;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Prismatic : RowJoint, BearingJoint {
  std::optional<Vec3> axis;  // left out: x
  TimeFunction angle;
  std::vector<double> orientation;
  std::optional<TimeFunction> position;
  std::optional<double> length, width;  // [m]

  Vec3 along(const World& world) const {
    const bool planar = world.space == Space::planar;
    return axis ? unit_axis(*axis, "axis") : planar ? Vec3(Vector2d::UnitX()) : Vec3(Vector3d::UnitX());
  }

  JointRows made_of(const World& world) const override {
    const Vec3 s = along(world);
    JointRows rows(world.space);
    rows.across(s).orientation(s, unit_quaternion(world, orientation, "orientation"), angle);
    if (position) rows.offset(s, *position);
    return rows;
  }

  void prepare(const World& world) override {
    RowJoint::prepare(world);
    if (width && world.space == Space::planar)
      throw ParameterError("width", "this scene is planar, where no moment turns about the axis; remove it");
    s_ = along(world);
    slip_ = JointRows(world.space).offset(s_);
  }

  void check_bearings(const World&) const override {}
  bool driven() const override { return position.has_value(); }
  void slip_row(double t, const Motion& A, const Motion& B, Rows& row) const override { slip_.rows(t, A, B, row); }

  void bearings(double, const Motion& A, const Motion&, Bearings& at) const override {
    const Vec3 s = A.R * s_;
    const bool planar = s.size() == 2;
    const AcrossAxis across = planar ? AcrossAxis::in_the_plane(s) : AcrossAxis::in_space(s);
    across.bear(length, at);
    if (width) at.C.row(at.add(1)).tail<3>() = 2 / *width * s.transpose();
  }

 private:
  Vec3 s_;  // in A's axes
  JointRows slip_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Prismatic>("prismatic", "slider: B moves along an axis of A and does not turn against it")
        .source("A. A. Shabana, Dynamics of Multibody Systems: prismatic joint")
        .parameter("axis", &Prismatic::axis,
                   {.doc = "direction of sliding in marker A's axes, any length; x if left out"})
        .parameter("angle", &Prismatic::angle,
                   {.unit = "rad",
                    .doc = "of B's frame against A's, in space about axis; a number or a law of t",
                    .derivatives = 2})
        .parameter("orientation", &Prismatic::orientation,
                   {.doc = "spatial: of B's frame against A's at angle 0, quaternion [w, x, y, z]; none if empty"})
        .parameter("position", &Prismatic::position,
                   {.unit = "m",
                    .doc = "of B along the axis, held to it: a number or a law of t; free if left out",
                    .derivatives = 2})
        .parameter(
            "length", &Prismatic::length,
            {.unit = "m",
             .min = 0,
             .above_min = true,
             .doc = "for friction: of the guide, centred at marker B; a moment across the axis presses with M/length "
                    "at both of its ends; if left out only the force across the axis rubs"})
        .parameter(
            "width", &Prismatic::width,
            {.unit = "m",
             .min = 0,
             .above_min = true,
             .doc = "for friction, spatial: between the guide's two rails, which a moment about the axis presses "
                    "with M/width each; if left out it does not rub"}))
