// The motion of one point of the surface, with a frame that turns with it: x along a_1, z along the normal n.
//
//     x = r + zeta n,   e_1 = a_1 / l,  e_2 = n x e_1,   l = |a_1|, s = a_2 . e_1, d = a_2 . e_2
//     omega = W_1 a_1' + W_2 a_2'
//     W_1 = -s/(l d) e_1 n^T - 1/l e_2 n^T + 1/l n e_2^T,      W_2 = 1/d e_1 n^T
//
// zeta [m] is the height over the mid-surface. The derivatives use the fact that every frame vector turns with omega.
#pragma once

#include <trammel/marker.hpp>
#include <trammel/matrix.hpp>

#include "tspline_plate/shell/discretisation.hpp"

namespace trammel::plate {

// A point of the mesh with its shape functions.
struct SurfacePoint {
  int cell = 0;
  double height = 0;  // zeta [m]
  ShapeValues shape;
};
SurfacePoint surface_point(const Discretisation& mesh, double u, double v, double height = 0);

struct Place {
  Vector3 r, a1, a2;
};
// sum of R, R_u, R_v times the control points, moved by q; or times the control points' velocities.
Place place(const Discretisation& mesh, const SurfacePoint& point, In q);
Place place_rate(const Discretisation& mesh, const SurfacePoint& point, In v);

void motion(const Discretisation& mesh, const SurfacePoint& point, In q, In v, Motion& motion);
void add_reaction_derivative(const Discretisation& mesh, const SurfacePoint& point, In q, const Wrench& F, double c,
                             Matrix& S);

// S(dofs, dofs) += c sum over pairs of R_u, R_v with the 6 x 6 matrix D of the rows (a_1, a_2): the tangent of
// generalised forces that depend on the two tangents at one point.
void add_tangent_of_tangents(const Cell& cell, const ShapeValues& shape, const Eigen::Matrix<double, 6, 6>& D, double c,
                             Matrix& S);

}  // namespace trammel::plate
