// Forces, or impulses, of all contacts at one instant: finds F of contact_point.hpp and the accelerations a = A F + b.
//
//  1. Without friction: the convex program of pressing_forces.hpp. It finds a solution or proves that there is none,
//     whatever the number of contacts and the rank of A.
//  2. With friction: Lemke's method on polyhedral_cone.hpp, first with a small compliance, then without. In space
//     Newton's method goes on to the round cone (friction_cone.hpp). Where rows depend on each other it begins with a
//     larger compliance, and goes on with springs along their self-stress: the solution that the phase after it has,
//     too.
//  3. Where that fails: all modes of few contacts, by branch and bound (mode_search.hpp), up to 24 in the plane and 4
//     in space. It finds a solution or proves, up to a bound, that there is none (Painleve). It gives up where
//     something comes near to a solution, 1e-8 of b, and is none, and after 20,000 sets of modes.
//
// Every answer is made exact (exact_modes.hpp), then it is checked: its violation of the conditions is returned with
// it. Degenerate problems end in a defined way: c N = 0 (a contact that just touches) leaves T = 0 and a_t as it is; a
// force exactly on its bound gives a_t = 0.
//
// Which one of several. Forces with the same accelerations: where no contact of a self-stress slides those of least
// norm, which are unique; else those of equal springs. Accelerations are unique without friction. With friction they
// may not be, and no rule is known that finds a particular solution; the first one found counts, of contacts in an
// order of their own (contact_order.hpp). So the answer does not depend on the order they are named in, except where
// contacts look alike; but it is not continuous: where two solutions come equally near to where the search begins,
// round-off may choose.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/programs/lcp.hpp"

namespace trammel::complementarity {

struct ContactSolution {
  LcpOutcome outcome = LcpOutcome::gave_up;  // no_solution: proved
  double violation = 0;                      // contact_point.hpp; of the best try where none was good enough
};

// Fills F and a, in the order of A and b, each row of which belongs to one contact; a is exactly 0 where the conditions
// say so. On anything but `solved` both are zero. `nothing`: accelerations that are 0, as those by which dependent
// contacts disagree.
ContactSolution solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a,
                               double nothing = 0);

}  // namespace trammel::complementarity
