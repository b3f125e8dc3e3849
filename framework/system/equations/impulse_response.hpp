// The changes of the velocities at the point by impulses on contacts, with the rows of bodies, joints and locked
// contacts active: M dv + G_b^T L_b = impulse, G_b dv = 0.
#pragma once

#include <functional>
#include <vector>

#include "system/equations/mass_and_force.hpp"
#include "system/equations/rows.hpp"

namespace trammel::model {

class ImpulseResponse {
 public:
  ImpulseResponse(Point& at, ContactsAtPoint& contacts, RowsAtPoint& rows, MassAndForceAtPoint& masses,
                  BodyBlocks* blocks, bool sparse)
      : at_(at), contacts_(contacts), rows_(rows), masses_(masses), blocks_(blocks), sparse_(sparse) {}

  // The rows must be evaluated. Column i of `jump` is dv for a unit impulse along directions[i], and delassus(i, j) the
  // change of the rate of directions[i] by a unit impulse along directions[j]. Throws NotSolvable.
  void respond(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus);
  // Column i: the multipliers L_b of the rows that are held, for a unit impulse along directions[i].
  Mat held_by_joints(const std::vector<ContactDirection>& directions);
  // A pseudo-random velocity that the joints permit.
  Vec some_motion();
  Vec sizes_of_motions();  // of the velocities of one that no joint holds

 private:
  using Solver = std::function<void(const Vec& impulse, Vec& dv, Vec& on_joints)>;
  Solver with_joints_held();
  Vec unit_impulse(ContactDirection d);
  void clear_held(const Mat& N, Mat& jump, Mat& delassus);

  Point& at_;
  ContactsAtPoint& contacts_;
  RowsAtPoint& rows_;
  MassAndForceAtPoint& masses_;
  BodyBlocks* blocks_;
  bool sparse_;
};

}  // namespace trammel::model
