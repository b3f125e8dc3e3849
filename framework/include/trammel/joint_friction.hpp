// Coulomb's friction in joints: along the one motion that a joint leaves free, under the forces with which it guides it.
//
//     s = H_A V_A + H_B V_B + s_t   [m/s]  slip, where the joint bears: along a guide, at the radius of a journal
//     p_k = C_k w                   [N]    load of bearing k in its 1 or 2 directions; w: wrench on B at marker B by the joint's rows
//     N = sum_k |p_k|               [N]    what the friction law takes as normal force (friction.hpp)
//     T                             [N]    |T| <= mu_0 N at rest, T = -mu N s/|s| while it slides; along s, so on B where s is B's
//
// N is homogeneous in the reaction, which the friction changes in turn; the framework solves for both.
#pragma once

#include <array>

#include <trammel/joint.hpp>

namespace trammel {

// The loads p_k of all bearings at one instant.
struct Bearings {
  Mat6 C;                         // (rows x twist) their C_k, one below the other; at most 6 rows
  std::array<int, 3> sizes = {};  // rows of each
  int count = 0;

  void begin(Space space) { C.resize(0, twist_size(space)), count = 0; }
  // Another bearing, with the rows of C_k; they come in zero. Returns the first.
  int add(int rows);
};

// Ability of joints between two markers.
class BearingJoint {
 public:
  virtual ~BearingJoint();
  // Throws a ParameterError that names what the joint lacks to rub. Asked once, after `prepare`, of joints with friction alone.
  virtual void check_bearings(const World&) const = 0;
  // One row: g [m] the place along the slip, H, g_t and gamma of its rate. `row` comes in zero.
  virtual void slip_row(double t, const Motion& A, const Motion& B, Rows& row) const = 0;
  // [m] how far it slid from one place to another; the shorter way round where a place does not count turns.
  virtual double slid(double from, double to) const { return to - from; }
  // The loads at unit components of w: `bearings` comes in begun.
  virtual void bearings(double t, const Motion& A, const Motion& B, Bearings& bearings) const = 0;
  // The free motion follows a law of time.
  virtual bool driven() const = 0;
};

}  // namespace trammel
