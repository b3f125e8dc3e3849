// Forces, or impulses, of all contacts at one instant: finds F of contact_point.hpp and the accelerations a = A F + b.
//
//  1. Without friction: the convex program of pressing_forces.hpp. It finds a solution or proves that there is none,
//     whatever the number of contacts and the rank of A.
//  2. With friction: Lemke's method on polyhedral_cone.hpp, first with a small compliance, then without. In space
//     Newton's method continues on the round cone (friction_cone.hpp). If rows depend on each other, the first
//     compliance is larger, and the exact shares of equal springs follow: the solution that the motion after the event
//     has, too.
//  3. If that fails: all modes of few contacts by branch and bound (mode_search.hpp), up to 24 contacts in the plane
//     and 4 in space. It finds a solution or proves, up to a bound on the forces, that there is none (Painleve). It
//     gives up if something comes within 1e-8 of b of a solution and is none, and after 20,000 sets of modes. That may
//     take minutes, so it is left out (ModeSearch::none) where the lack of a solution leaves things as they are.
//  4. If that is not possible or gives up: sweeps over the contacts until Newton's method ends in a solution.
//
// Every answer is made exact (exact_modes.hpp) and checked; its violation of the conditions is returned. Degenerate
// problems have a defined result: c N = 0 (a contact that just touches) gives T = 0 and leaves a_t as it is; a force
// exactly on its bound gives a_t = 0.
//
// If several solutions exist. Of forces with the same accelerations those of least norm are taken, which are unique, if
// no contact of a self-stress slides; otherwise those of equal springs. Accelerations are unique without friction. With
// friction they may not be, and no rule is known that finds a particular solution: the first one found counts, for
// contacts in an order of their own (contact_order.hpp). So the answer does not depend on the order in which contacts
// are named, except among contacts that look alike. It is not continuous: if two solutions are equally near to the
// start of the search, round-off may choose. So the solution near one that is known is sought first. Where a slip ends,
// rest comes before all others if springs that are pushed as until then hold it (forces_at_rest.hpp).
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/programs/lcp.hpp"

namespace trammel::complementarity {

struct ContactSolution {
  LcpOutcome outcome = LcpOutcome::gave_up;  // no_solution is proved
  double violation = 0;                      // of the returned solution, or of the best try (contact_point.hpp)
};

// Fills F and a, in the order of A and b, each row of which belongs to one contact; a is exactly 0 where the conditions
// say so. Both are zero unless the outcome is `solved`. `nothing`: accelerations that count as 0, such as those by
// which dependent contacts disagree.
ContactSolution solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a,
                               double nothing = 0);
// A solution of nearly the same problem, as a moment before, in the order of A and b; empty if none is known.
struct NearbySolution {
  Vec F, a;
};

enum class ModeSearch { of_few_contacts, none };  // step 3

// Which of several solutions with friction is sought first: rest, where contacts have pressed until now with the normal
// forces N, in the order of b (forces_at_rest.hpp), then the one near `nearby`. Both may be unknown.
struct Preference {
  NearbySolution nearby = {};
  Vec N = {};
};

// The same, with a `nothing` for each contact, of which the largest of an island counts in it. Fills `violation`, that
// of each contact's island, as far as islands are solved.
ContactSolution solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a,
                               const std::vector<double>& nothing, std::vector<double>& violation,
                               const Preference& first = {}, ModeSearch search = ModeSearch::of_few_contacts);

}  // namespace trammel::complementarity
