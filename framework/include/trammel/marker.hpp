// Markers: points and frames of bodies. Joints, forces and contacts act between them.
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel {

// A marker at one instant. Twists stack linear over angular parts in world axes (3 rows planar, 6 spatial).
//     V = J v + V_t        A = J v' + bias
// V_t is the part prescribed by time (a moving base); J acts on the body's dofs listed in `dofs`.
struct Motion {
  Vec3 x;                 // position, world axes [m]
  Mat3 R;                 // orientation: columns are the marker's axes in world axes
  double angle = 0;       // planar: angle of the marker's x axis, with full turns [rad]
  Vec6 V;                 // velocity [m/s; rad/s]
  Vec6 bias;              // acceleration at v' = 0 [m/s^2; rad/s^2]
  std::vector<int> dofs;  // local velocity indices of the body, set once per layout
  Jac J;                  // twist_size x dofs.size()
};

// Force, then moment, in world axes at the marker [N; N m]. Generalised force on the body: J^T wrench.
using Wrench = Vec6;

// Derivatives of the wrenches on two markers by small twists of both (translation, then rotation about world axes), or
// by their velocities: d(wrench on A) = AA d(twist of A) + AB d(twist of B), and so on.
struct PairTangent {
  Mat6 AA, AB, BA, BB;
};

// Constraint rows between markers A and B, or up to four (n <= 6 rows).
//     g_dot = H_A V_A + H_B V_B + ... + g_t,        H_A A_A + H_B A_B + ... = gamma
struct Rows {
  static constexpr int most_markers = 4;

  Vec6 g;                   // (n)
  Mat6 H_A, H_B, H_C, H_D;  // (n x twist); no rows for markers that do not exist
  Vec6 g_t;                 // (n) partial derivative by time
  Vec6 gamma;               // (n) without the markers' bias; assembly subtracts it

  Mat6& H(int marker) { return marker == 0 ? H_A : marker == 1 ? H_B : marker == 2 ? H_C : H_D; }
  const Mat6& H(int marker) const { return marker == 0 ? H_A : marker == 1 ? H_B : marker == 2 ? H_C : H_D; }

  // Sets n rows, all zero.
  void resize(int n, Space space, int markers = 2);
};

}  // namespace trammel
