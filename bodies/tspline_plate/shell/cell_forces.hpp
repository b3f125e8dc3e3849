// Elastic and damping forces of one Bezier cell, their energy and their tangent.
//
//     f_I = -int sum_k R_I^k g_k dA,     K_IJ = int sum_kl R_I^k R_J^l H_kl dA,     R^k = R_u, R_v, R_uu, R_vv, R_uv
//
// g and H are those of the material point. Damping is of Kelvin and Voigt: stresses C^ (strain + tau strain rate),
// which does no work in rigid motion; tau [s] is the stiffness factor of Rayleigh's damping.
#pragma once

#include <trammel/system.hpp>

#include "tspline_plate/shell/discretisation.hpp"

namespace trammel::plate {

// Displacements or velocities of a cell's functions, x, y and z apart, each padded.
using CellVectors = double[3 * most_functions];
void gather(const Cell& cell, In of_q, CellVectors& u);
void scatter(const Cell& cell, const CellVectors& f, double factor, Out of_q);  // += factor B^T f

struct CellEnergy {
  double membrane = 0, bending = 0;  // [J]
  double dissipated = 0;             // [W]
};
// Adds to f the gradient of the energy (minus the force); f or energy may be null. v null: at rest.
void add_elastic(const Cell& cell, const CellVectors& u, const CellVectors* v, double tau, CellVectors* f,
                 CellEnergy* energy);

// block(3 I + i, 3 J + j) = c_k K + c_d D + c_m M, column-major of size 3 functions. `carried`, for a cell without
// damping: the stresses of K are not those at u.
struct CarriedStrains {
  CellVectors from, increment;  // strain(from) + d(strain)/du increment
};
void cell_tangent(const Cell& cell, const CellVectors& u, const CellVectors* v, double tau, Blend c,
                  double mass_damping, double* block, const CarriedStrains* carried = nullptr);

}  // namespace trammel::plate
