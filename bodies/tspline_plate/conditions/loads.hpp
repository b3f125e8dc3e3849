// Loads that follow the surface: moments on edges, and pressure.
//
// An edge moment m [N m per m of the reference] turns the edge towards the normal n and keeps doing so as the edge
// moves:
//     f_I = int m (R_u,I a^1 . nu + R_v,I a^2 . nu) n ds,     nu: in the surface, across the edge, outwards
// Pressure p [N/m^2] acts along n on the deformed area:
//     f_I = int p R_I a_1 x a_2 du dv
// Neither has a potential in general; their tangents are not symmetric.
#pragma once

#include <trammel/matrix.hpp>

#include "tspline_plate/conditions/edge.hpp"
#include "tspline_plate/shell/cell_forces.hpp"
#include "tspline_plate/shell/surface_point.hpp"

namespace trammel::plate {

struct EdgePoint {
  SurfacePoint point;
  double length;    // of the part of the reference edge that it represents [m]
  Vector3 outward;  // nu of the reference
};
std::vector<EdgePoint> edge_points(const Discretisation& mesh, int patch, const Edge& edge);

void add_edge_moment(const Discretisation& mesh, const Edge& edge, const std::vector<EdgePoint>& points, double moment,
                     In q, Out f);
// S += c d(-f)/dq
void add_edge_moment_tangent(const Discretisation& mesh, const Edge& edge, const std::vector<EdgePoint>& points,
                             double moment, In q, double c, Matrix& S);

// Adds pressure times int R_I a_1 x a_2 to the cell's forces, and c times minus its derivative to a block of size 3
// functions, column-major.
void add_pressure(const Cell& cell, const CellVectors& u, double pressure, CellVectors& f);
void add_pressure_tangent(const Cell& cell, const CellVectors& u, double pressure, double c, double* block);

}  // namespace trammel::plate
