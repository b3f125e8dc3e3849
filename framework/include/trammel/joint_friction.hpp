// Coulomb friction in joints: it acts along the joint's one free motion and depends on the loads of the joint's
// bearings.
//
//     s = H_A V_A + H_B V_B + s_t   [m/s]  slip at the bearing surface: along a guide, or at the radius of a journal
//     p_k = C_k w                   [N]    load of bearing k in its 1 or 2 directions; w: wrench on B at marker B
//                                          from the joint's rows
//     N = sum_k |p_k|               [N]    the normal force that the friction law uses (friction.hpp)
//     T                             [N]    |T| <= mu_0 N at rest, T = -mu N s/|s| in sliding; along s, on B where s
//                                          is the slip of B
//
// N is homogeneous in the reaction, and the friction changes the reaction; the framework solves for both together.
#pragma once

#include <array>

#include <trammel/joint.hpp>

namespace trammel {

// The loads p_k of all bearings at one instant.
struct Bearings {
  Mat6 C;                         // (rows x twist) the C_k stacked; at most 6 rows
  std::array<int, 3> sizes = {};  // rows of each C_k
  int count = 0;

  void begin(Space space) { C.resize(0, twist_size(space)), count = 0; }
  // Adds a bearing with this many rows of C, all zero. Returns the index of the first.
  int add(int rows);
};

// Ability of joints between two markers.
class BearingJoint {
 public:
  virtual ~BearingJoint();
  // Throws a ParameterError that names what the joint lacks for friction. Called once, after `prepare`, if the joint
  // has friction.
  virtual void check_bearings(const World&) const = 0;
  // One row: g [m] is the position along the slip; H, g_t and gamma describe its rate. `row` is zero on entry.
  virtual void slip_row(double t, const Motion& A, const Motion& B, Rows& row) const = 0;
  // Distance slid between two positions [m]; the shorter arc if a position does not count turns.
  virtual double slid(double from, double to) const { return to - from; }
  // Adds all bearings with their C_k; `begin` was called on `bearings` before.
  virtual void bearings(double t, const Motion& A, const Motion& B, Bearings& bearings) const = 0;
  // True if the free motion follows a law of time.
  virtual bool driven() const = 0;
};

}  // namespace trammel
