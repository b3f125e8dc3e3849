#include "linear/dense/orthonormal.hpp"

namespace trammel::numerics {

Mat orthonormal(const Mat& columns) {
  return Eigen::HouseholderQR<Mat>(columns).householderQ() * Mat::Identity(columns.rows(), columns.cols());
}

Vec solve_transposed(const Eigen::CompleteOrthogonalDecomposition<Mat>& A, const Vec& b) {
  return A.transpose().solve(b);
}

}  // namespace trammel::numerics
