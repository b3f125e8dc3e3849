// Marker B stays on a line through marker A that is fixed in A's frame; it turns freely.
//
//     g = e . d = 0     d = x_B - x_A; e the directions of A across the axis s: one planar, two spatial
//     s . d - position(t)     with "position": a point carried along the line
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct PointOnLine : RowJoint {
  std::optional<Vec3> axis;  // left out: x
  std::optional<TimeFunction> position;

  JointRows made_of(const World& world) const override {
    const bool planar = world.space == Space::planar;
    const Vec3 s = axis ? unit_axis(*axis, "axis") : planar ? Vec3(Vector2d::UnitX()) : Vec3(Vector3d::UnitX());
    JointRows rows(world.space);
    rows.across(s);
    if (position) rows.offset(s, *position);
    return rows;
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<PointOnLine>("point_on_line", "pin in a slot: B stays on a line of A and turns freely")
                   .source("J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994")
                   .parameter("axis", &PointOnLine::axis,
                              {.doc = "direction of the line in marker A's axes, any length; x if left out"})
                   .parameter("position", &PointOnLine::position,
                              {.unit = "m",
                               .doc = "of B along the line, held to it: a number or a law of t; free if left "
                                      "out",
                               .derivatives = 2}))
