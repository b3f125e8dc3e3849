// An edge that is one point, with a smooth surface about it: the pole of a sphere, the top of a dome.
//
//     u_e = u_0,   u_s = u_0 + B (P_s - P_0)        e: edge row, s: second row, B: 3 x 2 in the plane of the second row
//
// r_across = 3 sum N_j w_e f (P_s - P_e) / W along the edge, f as in seam.hpp; with u added it is that of the reference
// under one linear map, so the tangents at the point stay in one plane. Two points of the second row in different
// directions determine B and with it the others. Around a full turn these are C1 polar splines (Toshniwal, Speleers,
// Hiemstra, Hughes, CMAME 316, 2017).
#pragma once

#include "tspline_plate/conditions/edge.hpp"

namespace trammel::plate {

// Throws std::invalid_argument: the edge is longer than a point, or the surface has a tip there.
void hold_pole(const PatchNet& net, const Edge& edge, Elimination& elimination);

}  // namespace trammel::plate
