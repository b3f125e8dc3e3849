// The exact forces in the modes of a nearby solution; for dependent contacts with the documented shares:
//
//     rows R: normals that are closed, tangents that stick:   a_R = A_R F + b_R = 0,   T = p N where a contact slides
//
// If the rows are independent, these equations have one solution; otherwise that of carrying_rows.hpp is taken.
//
// A mode that its own forces contradict is changed, one at a time: a contact that pulls opens, one that approaches
// closes, one whose force leaves its cone slides, one whose force would drive its slip sticks. The nearby solution may
// have any small error. If sliding contacts share, contacts without a force stay idle and those at their bounds stay
// there.
#pragma once

#include <vector>

#include "complementarity/shares/carrying_rows.hpp"

namespace trammel::complementarity {

// The role of each contact in a solution; accelerations below `nothing` count as 0.
std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing);

// Changes F to the exact solution; `a` are its accelerations, wrong by at most `nearby` of them, possibly of compliant
// contacts. False: it found none. On return `a` are the accelerations of the exact F, with 0 along rows that follow
// from others at rest. (Those differ from 0 by the angle that counts as round-off, times other accelerations. Example:
// a block on one corner, a nanometre from flat, against a wall. It turns about the corner, and it is not decided
// whether the other corner presses on the wall by a wedge of 1e-9 rad.)
[[nodiscard]] bool make_exact(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nearby,
                              Vec& F, Vec& a);

}  // namespace trammel::complementarity
