// A ball joint: the two markers coincide and turn freely. In the plane it is a hinge.
//
//     g = x_B - x_A = 0   (3 rows, planar 2)      lambda [N]: the force on B is -lambda, on A +lambda, in world axes
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Spherical : RowJoint {
  JointRows made_of(const World& world) const override { return JointRows(world.space).same_point(); }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<Spherical>("spherical", "ball joint: two markers share one point")
                   .source("A. A. Shabana, Dynamics of Multibody Systems: spherical joint"))
