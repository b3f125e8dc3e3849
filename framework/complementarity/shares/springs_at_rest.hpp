// Forces of contacts at rest whose normals press as springs do.
//
// Contacts that share could press against each other with any force (floor and ceiling of a channel without clearance)
// and hold by their friction whatever pushes. Springs do not press so: they take
//
//     N = argmin |N|^2 / 2,    E_n N = lambda - E_t T,    N >= 0,        so that N = max(0, E_n^T y),
//
// for friction T of any size inside the cones. With the contacts that press known, A, this is linear in their forces
// and in the slacks x of the others, which the push y would part:
//
//     Z^T (N_A, -x) = 0,    N_A >= 0,    x >= 0;        the columns of Z are the self-stresses, E_n Z = 0
//
// says that (N_A, -x) is E_n^T y. So the forces are those of admissible_forces.hpp for the contacts of A, with these
// rows added to E and a column for each x. A follows from T, and is found by repetition. Where the sets that come up
// hold nothing, all sets are judged, so the answer is certain and does not depend on the order of contacts. They are
// few: only contacts with a part in a self-stress may part, and slacks for given N_A exist only if they do with no more
// positive ones than columns of Z (Caratheodory). Of more than 8 contacts, if the sets are too many, one is
// sought by branches: each contact may have a force and a slack at first, and those with both are decided one by one.
// Without friction a self-stress holds nothing, so all admissible forces count.
//
// Forces that are in balance with each other inside the cones may be of any size: a strut between floor and ceiling
// could be wedged in at any time. While loads change little by little, springs do not wedge it in: they pass from one
// set to another only by forces that belong to both, those of the one set where contacts that change have neither a
// force nor a slack. So the set that held before (SharingContact::spring) holds as long as it can, and then only sets
// that are reached from it in this way count (`find_springs`). Where nothing can be wedged in, all sets do. Otherwise
// how far springs are pushed follows the loads (complementarity/spring_motion.hpp).
#pragma once

#include <optional>
#include <vector>

#include "complementarity/shares/admissible_forces.hpp"

namespace trammel::complementarity {

// Whether forces inside the cones are in balance with each other, so that they may be of any size (a strut that locks).
// Friction under given loads may be of any size as well: the loads of joints grow with the forces of contacts.
bool can_be_wedged_in(const std::vector<SharingContact>& contacts, const Mat& E);

// Fills F; false if no such forces have the resultants lambda. `carried`: the largest |E F - lambda| / |lambda|. Here
// and below, contacts whose springs are decided press or part as they say.
[[nodiscard]] bool forces_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda,
                                     double carried, Vec& F);
// The spare load (spare_load.hpp) of such forces, bounded where there is much. Fills F with the forces of its solution,
// if it is not null.
double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda,
                             Vec* F = nullptr);
// The same beside contacts that slide. They have normal forces only, whose columns in E are those of n + p t, while
// their springs yield along n: `push` has the columns of n for the normal forces of all, which take the place of E_n.
double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push,
                             const Vec& lambda, Vec* F = nullptr);

// The set of springs that holds: that of `contacts`, which has held so far, or where it does no more, one that follows;
// undecided where no self-stress can hold anything. If none has held so far, or the loads have jumped, all sets count.
// None holds: nothing. `round_off` [N]: a spare load may be as negative.
std::optional<SpringsThatHold> find_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push,
                                            const Vec& lambda, double round_off);

}  // namespace trammel::complementarity
