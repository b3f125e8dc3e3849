// Strain rates at a quadrature point, and the contribution of damping to the tangent.
//
//     eps' = (a_1 . a_1', a_2 . a_2', a_1 . a_2' + a_2 . a_1'),    kappa_k' = -f_k (c_k' . n - sum_a G^a_k n . a_a')
//
// with f = (1, 1, 2). The stresses tau C^ (eps', kappa') are objective and dissipate tau (eps', kappa') C^ (eps',
// kappa').
#pragma once

#include "tspline_plate/shell/material_point.hpp"

namespace trammel::plate {

struct StrainRate {
  Strain eps, kappa;
};
// `rate` are the velocities of y: rows a_1', a_2', c_1', c_2', c_3'.
StrainRate strain_rate(const DeformedPoint& at, const Vectors5& rate);

// += factor * (c_d B^T C^ B + c_k B^T C^ d(strain rate)/dy), B = d(strain)/dy, into the nine planes xx yy zz xy xz yz
// yx zx zy. The geometric part of the viscous stresses belongs to add_hessian.
void add_viscous(const ReferencePoint& reference, const DeformedPoint& at, const Vectors5& rate, double factor,
                 double c_d, double c_k, double (&H)[9][25]);

}  // namespace trammel::plate
