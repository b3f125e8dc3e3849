// The four edges of a patch and what holds them.
//
// The border of a T-mesh has its control points in rows: the edge row, which is the edge curve, and the second row, which
// with it gives the slope there. Every point of the second row has its partner in the edge row.
//     hinged     edge row
//     clamped    edge row, and of the second row the component along the surface normal
//     symmetric  edge row along the normal of the plane of symmetry; second row tied to it in the two directions within
//     x, yz, ..  these components of the edge row (a diaphragm holds two)
#pragma once

#include <string>

#include "control_net.hpp"
#include "elimination.hpp"

namespace trammel::plate {

struct Edge {
  int direction;  // 0: u = const, 1: v = const
  bool high;      // at the high end of the parameter
};
inline constexpr Edge edges[4] = {{0, false}, {0, true}, {1, false}, {1, true}};
inline constexpr const char* edge_names[4] = {"u0", "u1", "v0", "v1"};

struct EdgeRows {
  std::vector<int> edge, second;  // anchors by number, partners at the same place
};
EdgeRows rows(const TsplineBasis& basis, const Edge& edge);

// The parameters of a point of the edge, `along` in the parameter that runs along it.
Eigen::Vector2d on_edge(const TsplineBasis& basis, const Edge& edge, double along);

// Throws std::invalid_argument: a condition nobody knows, an edge that lies in no plane of symmetry.
void hold_edge(const TsplineBasis& basis, const Points& points, const Edge& edge, const std::string& condition,
               Elimination& elimination);

// Joins the high edge of this direction to the low one, C1: a closed tube. Both edge rows become one, and it lies between
// the second rows:  (w_s / tau + w_s' / tau') u_e = w_s / tau u_s + w_s' / tau' u_s',  tau the first knot span.
// Throws std::invalid_argument: the rows do not match, or the reference has a gap or a kink there.
void join_ends(const TsplineBasis& basis, const Points& points, int direction, Elimination& elimination);

// "xz" and the like: the components, 0 to 2. Empty: the text is something else.
std::vector<int> axes_in(const std::string& text);

}  // namespace trammel::plate
