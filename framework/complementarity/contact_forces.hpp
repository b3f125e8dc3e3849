// Forces, or impulses, of all contacts at one instant: finds F of contact_point.hpp and the accelerations a = A F + b.
//
//  1. Without friction: the convex program of pressing_forces.hpp. It finds a solution or proves that there is none.
//  2. With friction: Lemke's method on polyhedral_cone.hpp, first with a small compliance, then without. In space Newton's method
//     goes on to the round cone (friction_cone.hpp).
//  3. Where that fails, in the plane: all modes of few contacts, by branch and bound (mode_search.hpp). It finds a solution or proves
//     that there is none (Painleve).
//
// Every answer is made exact, and of dependent contacts the documented one (exact_modes.hpp); then it is checked: its violation of
// the conditions is returned with it. Degenerate problems end in a defined way: c N = 0 (a contact that just touches) leaves T = 0 and
// a_t as it is; a force exactly on its bound gives a_t = 0.
#pragma once

#include <vector>

#include "complementarity/contact_point.hpp"
#include "complementarity/lcp.hpp"

namespace trammel::complementarity {

struct ContactSolution {
  LcpOutcome outcome = LcpOutcome::gave_up;  // no_solution: proved
  double violation = 0;                      // contact_point.hpp; of the best try where none was good enough
};

// Fills F and a, in the order of A and b; a is exactly 0 where the conditions say so. On anything but `solved` both are zero.
// `nothing`: accelerations that are 0, as those by which dependent contacts disagree.
ContactSolution solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a,
                               double nothing = 0);

}  // namespace trammel::complementarity
