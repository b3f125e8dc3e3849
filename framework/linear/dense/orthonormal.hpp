// Functions with Eigen's orthogonal decompositions, each of which takes seconds to compile.
#pragma once

#include <trammel/decompositions.hpp>

namespace trammel::numerics {

// An orthonormal basis of the range of independent columns; it has the size of `columns`.
Mat orthonormal(const Mat& columns);

// x of least norm with A^T x = b, in the least-squares sense; A is the decomposed matrix.
Vec solve_transposed(const Eigen::CompleteOrthogonalDecomposition<Mat>& A, const Vec& b);

}  // namespace trammel::numerics
