// A Kirchhoff-Love shell of St Venant-Kirchhoff material at one quadrature point.
//
//     a_1 = r_u, a_2 = r_v, n = a_1 x a_2 / |a_1 x a_2|,   c_k = r_uu, r_vv, r_uv,   b_k = c_k . n
//     eps = ((a_11 - A_11) / 2, (a_22 - A_22) / 2, a_12 - A_12),   kappa = (B_11 - b_11, B_22 - b_22, 2 (B_12 - b_12))
//     density of energy  h/2 eps^T C^ eps + h^3/24 kappa^T C^ kappa   per reference area [J/m^2]
//
// Capitals are the reference. C^ = T^T C T is the plane stress stiffness C in the local Cartesian frame e_1 = A_1 /
// |A_1|, brought to the curvilinear components by T. Everything acts on the five vectors y = (a_1, a_2, c_1, c_2, c_3):
// the gradient is one 5 x 3 array, the Hessian one 15 x 15 matrix. Strains are taken from displacements d = y - Y,
// which keeps their digits when they are small. Kiendl, Bletzinger, Linhard, Wuechner, CMAME 198, 2009; curvature
// change B - b with the unit normal (Koiter).
#pragma once

#include <Eigen/Core>

namespace trammel::plate {

using Vector3 = Eigen::Vector3d;
using Vectors5 = Eigen::Matrix<double, 5, 3, Eigen::RowMajor>;  // rows a_1, a_2, c_1, c_2, c_3
using Strain = Eigen::Vector3d;                                 // components 11, 22, 12 with the factor 2
using Matrix3 = Eigen::Matrix3d;

// The plate's section: constant over the plate.
struct Section {
  double thickness = 0;       // [m]
  double youngs_modulus = 0;  // [Pa]
  double poissons_ratio = 0;
};
// Plane stress: stress (xx, yy, xy) = C strain (xx, yy, 2 xy).
Matrix3 plane_stress(const Section& section);

struct ReferencePoint {
  Vectors5 Y;
  Vector3 N;         // unit normal
  double area = 0;   // |A_1 x A_2|
  Matrix3 T;         // curvilinear strain (11, 22, 2 12) to (xx, yy, 2 xy) in the local frame
  Matrix3 membrane;  // h C^ [N/m]
  Matrix3 bending;   // h^3/12 C^ [N m]
  // False: the surface is degenerate there (A_1 x A_2 = 0).
  bool set(const Vectors5& reference, const Section& section);
};

// The deformed point: bases, strains, and what force and tangent are made of.
struct DeformedPoint {
  Vectors5 y;
  Vector3 n;
  Vector3 dual[2];   // a^1, a^2
  double metric[3];  // a^11, a^22, a^12
  double area;       // |a_1 x a_2|
  Strain eps, kappa;
  Vector3 christoffel[2];  // G^a_k = c_k . a^a, k = 1..3
};

void deform(const ReferencePoint& reference, const Vectors5& displacement, DeformedPoint& at);

// Gradient by y of  resultants . (eps, kappa): membrane [N/m], moment [N m].
void add_gradient(const DeformedPoint& at, const Strain& membrane, const Strain& moment, Vectors5& g);

// The 15 x 15 Hessian as six symmetric-in-pairs planes: plane (i, j) holds d2 / dy_p,i dy_q,j at [5 p + q].
// Order of the planes: xx, yy, zz, xy, xz, yz.
using Planes = double[6][25];
// += factor * (Hessian of the energy density), with the stresses `membrane`, `moment` in the geometric part.
void add_hessian(const ReferencePoint& reference, const DeformedPoint& at, const Strain& membrane, const Strain& moment,
                 double factor, Planes& H);

}  // namespace trammel::plate
