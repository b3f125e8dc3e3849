// A weld: the two markers coincide and have a fixed relative orientation, which may follow a law of time (a rotary
// drive).
//
//     g = (x_B - x_A, orientation of B against A) = 0        3 rows planar, 6 spatial
//
// planar theta_B = theta_A + angle; spatial R_B = R_A turn(axis, angle) orientation. lambda [N, N m].
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector3d;

struct Fixed : RowJoint {
  TimeFunction angle;
  std::optional<Vec3> axis;
  std::vector<double> orientation;

  JointRows made_of(const World& world) const override {
    return JointRows(world.space)
        .same_point()
        .orientation(spatial_axis(world, axis, "axis"), unit_quaternion(world, orientation, "orientation"), angle);
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Fixed>("fixed", "weld: two markers share one point and one orientation")
        .source("A. A. Shabana, Dynamics of Multibody Systems: rigid joint")
        .parameter("angle", &Fixed::angle,
                   {.unit = "rad",
                    .doc = "of B's frame against A's, in space about axis; a number or a law of t",
                    .derivatives = 2})
        .parameter("axis", &Fixed::axis,
                   {.doc = "spatial: what angle turns about, in marker A's axes; [0, 0, 1] if left out"})
        .parameter("orientation", &Fixed::orientation,
                   {.doc = "spatial: of B's frame against A's at angle 0, quaternion [w, x, y, z]; none if empty"}))
