// A slider: marker B moves along a line fixed in marker A's frame and does not turn against A.
//
//     e . d                              d = x_B - x_A; e the directions of A across its axis s: one planar, two spatial
//     orientation of B against A         planar theta_B - theta_A - angle; spatial R_B = R_A turn(s, angle) orientation
//     s . d - position(t)                with "position": an ideal linear drive
//
// The offset angle may be a law of time too. lambda of the first rows [N] presses across the guide.
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Prismatic : RowJoint {
  std::optional<Vec3> axis;  // left out: x
  TimeFunction angle;
  std::vector<double> orientation;
  std::optional<TimeFunction> position;

  JointRows made_of(const World& world) const override {
    const bool planar = world.space == Space::planar;
    const Vec3 s = axis ? unit_axis(*axis, "axis") : planar ? Vec3(Vector2d::UnitX()) : Vec3(Vector3d::UnitX());
    JointRows rows(world.space);
    rows.across(s).orientation(s, unit_quaternion(world, orientation, "orientation"), angle);
    if (position) rows.offset(s, *position);
    return rows;
  }
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
                    .derivatives = 2}))
