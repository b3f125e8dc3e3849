// A joint of two edges across which the surface continues: between two patches, or of two edges of one patch in a tube.
//
//     C0   u_e = u_e'                               common edge row, about which the patches turn freely (a hinge)
//     C1   (f + b f') u_e = f u_s + b f' u_s'       and each of its points stays between those of the second rows
//
// e: edge row, s: second row, ' the other side; f = w_s / (w_e tau) with the first knot span tau: for weights of a
// product of curves, however refined, r_across = 3 sum N_j w_e f (P_s - P_e) / W. b, how much faster the parameter
// across runs on this side, comes from the reference, which must be C1 with a constant b. Such conditions keep every
// pair of functions of both sides that match, so refinements stay nested.
#pragma once

#include <optional>
#include <string>

#include "tspline_plate/conditions/edge.hpp"
#include "tspline_plate/mesh/multipatch.hpp"

namespace trammel::plate {

enum class Continuity { C0, C1 };

struct PatchEdge {
  int patch;
  Edge edge;
  std::string name;  // as in the scene: "roof.u1", or "u1" where there is one patch
};

struct Seam {
  PatchEdge a, b;
  Continuity continuity;
  bool reversed;  // the parameter along the edge of b runs against that of a
};

// Throws std::invalid_argument: there is a gap between the edges.
Seam find_seam(const Multipatch& basis, const Points& points, PatchEdge a, PatchEdge b, Continuity continuity);

// Throws std::invalid_argument: knots or weights along the edges differ; C1: the reference has a kink, or b varies
// along the edge.
void join(const Multipatch& basis, const Points& points, const Seam& seam, Elimination& elimination);

// Elements at the seam that must be crossed to give the edge of either side a knot that only the other one has.
std::vector<Box<double>> behind(const Seam& seam, const TMesh& mesh_a, const TMesh& mesh_b);

// The same place in the parameters of the other side; nothing: the point does not lie on this seam.
std::vector<Eigen::Vector2d> other_sides(const Multipatch& basis, const Seam& seam, const Eigen::Vector2d& at);

}  // namespace trammel::plate
