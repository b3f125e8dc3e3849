// Joints with friction at the point: the loads of their bearings by the joints' multipliers.
//
//     N(lambda) = sum_k |L_k lambda'|,  L_k = C_k H_B^T     homogeneous of degree 1, so with n = dN/dlambda' at lambda
//     lambda' = lambda_J + D lambda_c                        lambda_J: of the joint's rows
//
// D lambda_c is what contacts that share forces, with the multipliers lambda_c in g, put on the joint: their rows
// follow from each other and from the joints' rows, so their shares change the joint's reaction (SharedRowsAtPoint).
//
//     W^T lambda = (G^T - r h^T n) lambda                   r = T/N while sliding, h: the row of the slip
//
// W^T lambda is the reaction at lambda, and W^T its derivative there. Hence solving with W of the last lambda is a
// Newton iteration. If the loads are scalars (a planar guide), n depends only on their signs, and the second iterate is
// exact.
#pragma once

#include <vector>

#include <trammel/joint_friction.hpp>
#include <trammel/system.hpp>

#include "system/point/contacts.hpp"

namespace trammel::model {

class JointFriction {
 public:
  JointFriction(Point& at, ContactsAtPoint& contacts);

  bool none() const { return bearings_.empty(); }
  const JointEntry& joint_of(int contact) const;
  // N [N] of these multipliers, with those `beside` them, of all joints
  double load(int contact, const Vec& lambda, const Vec& beside = {});
  const Vec6& load_by_row(int contact) const;  // n, with which W is formed
  struct Share {
    std::vector<int> rows;  // of lambda_c
    Mat D;                  // rows of the joint x `rows`
  };
  const Share& share(int contact) const;
  void clear_shares();
  void add_shares(const std::vector<int>& rows, const Mat& on_joints);  // on_joints: D of all rows of joints
  bool unload();                                                        // sets n = 0; false: it was 0
  struct Loaded {
    bool changed = false;  // n has changed, and so has W
    bool far = false;      // n . lambda differed from N(lambda) before
  };
  Loaded load_with(const Vec& lambda);  // updates n for these multipliers, for sliding joints
  [[noreturn]] void fail_without_loads();
  // S += c_k K + c_d D of the friction, or of the row by which the joint sticks.
  void add_tangent(int contact, Blend c, const Vec& lambda, Matrix& S);
  CallSite find_not_finite();

 private:
  struct Bearing {
    int contact = 0;
    long long point = -1;
    Bearings at = {};
    Mat6 loads = {};        // L: derivatives of the bearings' loads by the joint's multipliers [1]
    Vec6 load_by_row = {};  // n
    Share share = {};
  };
  Vec6 reaction(int contact, const Vec& lambda) const;  // lambda'
  Bearing& bearing(int contact);                        // at this point
  bool slides(int contact);                             // and has friction

  Point& at_;
  ContactsAtPoint& contacts_;
  std::vector<Bearing> bearings_;
  std::vector<int> bearing_of_;  // by contact: index into `bearings_`; empty if there are none
  Rows rows_;
};

}  // namespace trammel::model
