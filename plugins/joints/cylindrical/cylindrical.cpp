// A sleeve on a shaft: marker B moves along a line of A and turns about it; either motion may follow a law of time.
//
//     e_2 . d, e_3 . d             d = x_B - x_A; e_2, e_3 directions of A perpendicular to its axis n_A
//     e_2 . n_B, e_3 . n_B         the axes stay parallel
//     n_A . d - position(t)        with "position"
//     the angle of B against A minus angle(t)     with "angle"
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector3d;

struct Cylindrical : RowJoint {
  std::optional<Vec3> axis, axis_b;
  std::optional<TimeFunction> position, angle;

  JointRows made_of(const World& world) const override {
    if (world.space == Space::planar)
      throw ParameterError("type", "this scene is planar, where a sleeve cannot turn: use prismatic");
    const Vector3d n_A = spatial_axis(world, axis, "axis"), n_B = spatial_axis(world, axis_b, "axis_b", n_A);
    JointRows rows(world.space);
    rows.across(n_A).parallel(n_A, n_B);
    if (position) rows.offset(n_A, *position);
    if (angle) rows.angle(n_A, smallest_rotation(n_B, n_A), *angle);
    return rows;
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<Cylindrical>("cylindrical",
                                           "sleeve on a shaft: B slides along an axis of A and turns about it; spatial")
                   .source("A. A. Shabana, Dynamics of Multibody Systems: cylindrical joint")
                   .parameter("axis", &Cylindrical::axis,
                              {.doc = "direction in marker A's axes; [0, 0, 1] if left out"})
                   .parameter("axis_b", &Cylindrical::axis_b,
                              {.doc = "the same direction in marker B's axes; the numbers of axis if left out"})
                   .parameter("position", &Cylindrical::position,
                              {.unit = "m",
                               .doc = "of B along the axis, held to it: a number or a law of t; free if left out",
                               .derivatives = 2})
                   .parameter("angle", &Cylindrical::angle,
                              {.unit = "rad",
                               .doc = "of B against A, held to it: a number or a law of t; free if left out",
                               .derivatives = 2}))
