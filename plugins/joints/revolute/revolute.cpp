// A hinge: the two markers stay in one place, and in space share an axis; the angle is free, or a law of time.
//
//     g = x_B - x_A                                     2 rows planar, 3 spatial
//     e_2 . n_B, e_3 . n_B                              spatial: n_B across two directions of A perpendicular to its axis
//     the angle of B against A minus angle(t)           with "angle": an ideal rotary drive
//
// lambda [N] of the first rows: the joint pushes B with -lambda and A with +lambda, world axes.
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Revolute : RowJoint {
  std::optional<Vec3> axis, axis_b;
  std::optional<TimeFunction> angle;

  JointRows made_of(const World& world) const override {
    const Vector3d n_A = spatial_axis(world, axis, "axis"), n_B = spatial_axis(world, axis_b, "axis_b", n_A);
    JointRows rows(world.space);
    rows.same_point().parallel(n_A, n_B);
    if (angle) rows.angle(n_A, Quaterniond::FromTwoVectors(n_B, n_A), *angle);
    return rows;
  }
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
                    .derivatives = 2}))
