// The types that every other header uses: vectors, sizes, space, world.
#pragma once

#include <Eigen/Core>

#if !defined(EIGEN_MAX_ALIGN_BYTES) || !defined(EIGEN_MAX_STATIC_ALIGN_BYTES)
#error "build plugins against the CMake target trammel::sdk: it pins Eigen's alignment, which is part of the plugin ABI"
#endif

namespace trammel {

using Vec = Eigen::VectorXd;
using Mat = Eigen::MatrixXd;
using In = const Eigen::Ref<const Vec>&;  // a component's own segment of a system vector, read only
using Out = Eigen::Ref<Vec>;              // the same for writing; the framework sets its size

// Lengths of the system's vectors: q configuration (nq), v velocity (nv), lambda multipliers (nc rows of G).
struct Sizes {
  int nq = 0;
  int nv = 0;
  int nc = 0;
  bool operator==(const Sizes&) const = default;
};

// A planar scene has planar coordinates throughout: vectors with 2 entries, one rotation, no unused spatial entries.
enum class Space { planar, spatial };
constexpr int dimension(Space space) {
  return space == Space::planar ? 2 : 3;
}  // of a position
constexpr int rotations(Space space) {
  return space == Space::planar ? 1 : 3;
}  // of an angular velocity
constexpr int twist_size(Space space) {
  return dimension(space) + rotations(space);
}

// Small vectors and matrices with the scene's dimension and storage for three dimensions: they need no heap memory.
using Vec3 = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;                      // 2 or 3 entries
using Vec6 = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;                      // 3 or 6: linear, then angular
using Mat3 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;         // 2x2 or 3x3
using Mat6 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;         // rows x twist
using Jac = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // twist x dofs of one body

// The properties of the scene that a component can read.
struct World {
  Space space = Space::planar;
  Vec3 gravity = Vec3::Zero(2);  // [m/s^2], world axes
};

// Energies of a body or a force [J].
struct Energy {
  double kinetic = 0;
  double potential = 0;  // of gravity and other fields
  double elastic = 0;
  double total() const { return kinetic + potential + elastic; }
};

// Power of the effects that Energy does not include [W]. Along a motion d(total energy)/dt = supplied - dissipated.
struct Power {
  double supplied = 0;    // by drives and loads, either sign
  double dissipated = 0;  // by dampers, >= 0
};

}  // namespace trammel
