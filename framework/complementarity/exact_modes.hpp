// The exact forces in the modes of a nearby solution; for dependent contacts with the documented shares:
//
//     rows R: normals that are closed, tangents that stick:   a_R = A_R F + b_R = 0,   T = p N where a contact slides
//
// If the rows are independent, these equations have one solution; otherwise that of carrying_rows.hpp is taken.
//
// A mode that its own forces contradict is changed, one at a time: a contact that pulls opens, one that approaches
// closes, one whose force leaves its cone slides, one whose force would drive its slip sticks. The nearby solution may
// have any small error. If sliding contacts share, the normal forces are those of springs. A contact that pulls is idle
// as long as others hold its row; where they do not, it opens, or carries a force that presses. Only if there are no
// such modes are other forces taken, and then contacts without a force stay idle and those at their bounds stay there.
#pragma once

#include <vector>

#include "complementarity/shares/carrying_rows.hpp"

namespace trammel::complementarity {

// Which of two scales of accelerations counts for the round-off along a contact's tangents: that of its own terms if
// the largest of all, that of a light body which is pushed or spins, is many times as large.
constexpr double round_off_of_slip = 1e-12;  // of that scale
inline double scale_of_slip(double own, double largest) {
  return largest > 100 * own ? own : largest;
}

// The role of each contact in a solution; accelerations below `nothing` count as 0.
std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing);
// The same, with the accelerations along tangents that count as 0 by contact.
std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing,
                                  const Vec& no_slip);

// Changes F to the exact solution; `a` are its accelerations, wrong by at most `nearby` of them, possibly of compliant
// contacts. False: it found none. On return `a` are the accelerations of the exact F, with 0 along rows that follow
// from others at rest. (Those differ from 0 by the angle that counts as round-off, times other accelerations. Example:
// a block on one corner, a nanometre from flat, against a wall. It turns about the corner, and it is not decided
// whether the other corner presses on the wall by a wedge of 1e-9 rad.)
[[nodiscard]] bool make_exact(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nearby,
                              Vec& F, Vec& a);

}  // namespace trammel::complementarity
