// The first k columns of the factor of a dense symmetric matrix, positive definite there, and what they leave of the
// rest:
//
//     [A_11 A_21^T]  =  [L_11  ] [L_11^T L_21^T]
//     [A_21 A_22  ]     [L_21 1] [         S   ]
//
// In place, lower triangles alone; what stands above them is lost. Columns are halved again and again, so that nearly
// all of the work is products of tiles that fit into registers (Andersen, Wasniewski, Gustavson, ACM Trans. Math.
// Softw. 27 (2001), 214).
#pragma once

#include <Eigen/Core>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// From column to column, for n rows: whole packs, an odd number of them, so that columns do not meet in the same lines
// of the cache.
constexpr Eigen::Index column_stride(Eigen::Index n) {
  return padded(n) | pack;
}
// A: n columns, column_stride(n) apart. False: not positive definite, or not finite.
[[nodiscard]] bool partial_cholesky(double* A, Eigen::Index n, Eigen::Index k);

}  // namespace trammel::numerics
