// The conditions at the four edges and corners of a patch.
//
// The border of a T-mesh has its control points in rows: the edge row, which is the edge curve, and the second row,
// which with it gives the slope there. Every point of the second row has its partner in the edge row.
//     hinged     edge row
//     clamped    edge row, and of the second row the component along the surface normal
//     symmetric  edge row along the normal of the plane of symmetry; second row tied to it in the two directions within
//     x, yz, ..  these components of the edge row (a diaphragm holds two)
#pragma once

#include <string>

#include "tspline_plate/mesh/control_net.hpp"
#include "tspline_plate/mesh/elimination.hpp"

namespace trammel::plate {

struct Edge {
  int direction;  // 0: u = const, 1: v = const
  bool high;      // at the high end of the parameter
};
inline constexpr Edge edges[4] = {{0, false}, {0, true}, {1, false}, {1, true}};
inline constexpr const char* edge_names[4] = {"u0", "u1", "v0", "v1"};

struct Corner {
  const char* name;
  int u_edge, v_edge;  // of `edges`
};
inline constexpr Corner corners[4] = {{"u0v0", 0, 2}, {"u1v0", 1, 2}, {"u0v1", 0, 3}, {"u1v1", 1, 3}};

// A patch among others: its anchors, counted from 0, are the control points from `first` on.
struct PatchNet {
  const TsplineBasis& basis;
  const Points& points;
  int first = 0;
  Eigen::Vector3d point(int anchor) const { return points.row(first + anchor); }
  int component(int anchor, int axis) const { return 3 * (first + anchor) + axis; }
};

struct EdgeRows {
  std::vector<int> edge, second;  // anchors of the patch along the edge; partners have the same index
};
EdgeRows rows(const TsplineBasis& basis, const Edge& edge);
int corner_anchor(const TsplineBasis& basis, const Corner& corner);  // which the surface passes through

// The parameters of a point of the edge, `along` in the parameter that runs along it.
Eigen::Vector2d on_edge(const TsplineBasis& basis, const Edge& edge, double along);

// r_u, r_v, r_uv of the reference.
struct Tangents {
  Eigen::Vector3d u, v, uv;
};
Tangents tangents(const PatchNet& net, const Eigen::Vector2d& at);

// Throw std::invalid_argument: an unknown condition, an edge that lies in no plane of symmetry.
void hold_edge(const PatchNet& net, const Edge& edge, const std::string& condition, Elimination& elimination);
void hold_corner(const PatchNet& net, const Corner& corner, const std::string& condition, Elimination& elimination);

// "xz" and the like: the components, 0 to 2. Empty for any other text.
std::vector<int> axes_in(const std::string& text);

}  // namespace trammel::plate
