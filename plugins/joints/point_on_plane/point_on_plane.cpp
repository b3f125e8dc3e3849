// Marker B stays in a plane of marker A's frame (a line, in planar scenes), at a height that may be a law of time.
//
//     g = n . (x_B - x_A) - height(t) = 0   (1 row)        lambda [N] presses along n
#include <trammel/joint_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct PointOnPlane : RowJoint {
  std::optional<Vec3> normal;
  TimeFunction height;

  JointRows made_of(const World& world) const override {
    const bool planar = world.space == Space::planar;
    const Vec3 n = normal   ? unit_axis(*normal, "normal")
                   : planar ? Vec3(Eigen::Vector2d::UnitY())
                            : Vec3(Eigen::Vector3d::UnitZ());
    return JointRows(world.space).offset(n, height);
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<PointOnPlane>("point_on_plane", "B stays in a plane of A and turns freely")
                   .source("J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994")
                   .parameter("normal", &PointOnPlane::normal,
                              {.doc = "of the plane in marker A's axes, any length; planar y, spatial z if left out"})
                   .parameter("height", &PointOnPlane::height,
                              {.unit = "m",
                               .doc = "of B over marker A along the normal; a number or a law of t",
                               .derivatives = 2}))
