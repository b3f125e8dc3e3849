// The functions of a T-mesh as combinations of those of a refined mesh, and with them points, weights and velocities.
//
//     B_i = sum_j M_ji B~_j,    w~ = M w,    P~ = diag(1 / w~) M diag(w) P
//
// M by dual functionals: M_ji = lambda_{u_j}(N[u_i]) lambda_{v_j}(N[v_i]), exact when both meshes are
// analysis-suitable. On others the Gram system G22 M = G21 is solved instead. Either way the identity is checked at 16
// points of every Bezier cell, which decides it for bicubics; a mesh that is not nested is refused.
#pragma once

#include <Eigen/SparseCore>

#include "tspline_plate/mesh/tspline_basis.hpp"

namespace trammel::plate {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

struct RefinementOperator {
  Sparse blending;          // M, new functions x old functions
  Eigen::VectorXd weights;  // w~
  Sparse points;            // diag(1 / w~) M diag(w)
  double nesting_error;     // the largest |B_i - sum_j M_ji B~_j| found
};

// Throws std::domain_error: the fine mesh does not contain the coarse functions, or a weight is no longer positive.
RefinementOperator refinement_operator(const TsplineBasis& coarse, const TsplineBasis& fine);

// Ratio of the smallest to the largest pivot of the Gram matrix of the functions, scaled to a unit diagonal: above
// round-off the functions are linearly independent. Analysis-suitable meshes need no such test.
double independence(const TsplineBasis& basis);

}  // namespace trammel::plate
