// The exact forces in the modes that a nearby solution shows, and of dependent contacts the ones that are documented:
//
//     rows R: normals that are closed, tangents that stick:   a_R = A_R F + b_R = 0,   T = p N where a contact slides
//
// Where rows are independent these equations have one solution; of dependent ones it is that of carrying_rows.hpp.
//
// A mode that its own forces contradict is changed, one at a time: a pull opens a contact, what approaches closes, a
// force beyond its cone slides, one that would drive the slip sticks. The nearby solution may be off by any small
// error.
#pragma once

#include <vector>

#include "complementarity/shares/carrying_rows.hpp"

namespace trammel::complementarity {

// Of a solution: what each contact does; smaller than `nothing` is no acceleration.
std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing);

// Changes F, whose accelerations `a` are off by no more than `nearby` of them, to the exact solution. False: it found
// none. `a` may be those of contacts that yield. On return they are those of the exact F, but 0 along rows that follow
// from others at rest: those differ from 0 by the angle to the others that counts as round-off, times what moves beside
// them. A block on one corner, a nanometre from flat, against a wall: it turns about the corner, and whether the other
// corner presses on the wall by a wedge of 1e-9 rad is not decided.
[[nodiscard]] bool make_exact(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nearby,
                              Vec& F, Vec& a);

}  // namespace trammel::complementarity
