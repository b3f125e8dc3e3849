// The first k columns of the Cholesky factor of a dense symmetric matrix whose leading k x k block is positive
// definite, and the Schur complement S:
//
//     [A_11 A_21^T]  =  [L_11  ] [L_11^T L_21^T]
//     [A_21 A_22  ]     [L_21 1] [         S   ]
//
// In place, lower triangles only; the entries above them are overwritten. Columns are halved recursively, so that
// nearly all of the work is products of tiles that fit into registers (Andersen, Wasniewski, Gustavson, ACM Trans.
// Math. Softw. 27 (2001), 214).
#pragma once

#include <Eigen/Core>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// Distance between columns of n rows: an odd number of whole packs, so that columns do not compete for the same cache
// lines.
constexpr Eigen::Index column_stride(Eigen::Index n) {
  return padded(n) | pack;
}
// A: n columns, column_stride(n) apart. False: not positive definite, or not finite.
[[nodiscard]] bool partial_cholesky(double* A, Eigen::Index n, Eigen::Index k);

}  // namespace trammel::numerics
