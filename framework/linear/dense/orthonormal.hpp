// Uses of Eigen's orthogonal decompositions that cost a compiler seconds each.
#pragma once

#include "linear/dense/decompositions.hpp"

namespace trammel::numerics {

// An orthonormal basis of what independent columns reach, of the columns' size.
Mat orthonormal(const Mat& columns);

// x of least norm with A^T x = b, in the least-squares sense; A is the decomposed matrix.
Vec solve_transposed(const Eigen::CompleteOrthogonalDecomposition<Mat>& A, const Vec& b);

}  // namespace trammel::numerics
