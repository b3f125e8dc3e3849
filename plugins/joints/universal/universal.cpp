// A universal (Cardan) joint: the two markers coincide, and an axis of A remains perpendicular to an axis of B.
//
//     g = (x_B - x_A, n_A . n_B) = 0   (4 rows), spatial
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector3d;

struct Universal : RowJoint {
  std::optional<Vec3> axis, axis_b;

  JointRows made_of(const World& world) const override {
    if (world.space == Space::planar)
      throw ParameterError("type", "this scene is planar, where a universal joint is a hinge: use revolute");
    return JointRows(world.space)
        .same_point()
        .dot(spatial_axis(world, axis, "axis", Vector3d::UnitX()),
             spatial_axis(world, axis_b, "axis_b", Vector3d::UnitY()));
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<Universal>("universal", "Cardan joint: one point, two perpendicular axes; spatial")
                   .source("A. A. Shabana, Dynamics of Multibody Systems: universal joint")
                   .parameter("axis", &Universal::axis, {.doc = "direction in marker A's axes; [1, 0, 0] if left out"})
                   .parameter("axis_b", &Universal::axis_b,
                              {.doc = "direction in marker B's axes; [0, 1, 0] if left out"}))
