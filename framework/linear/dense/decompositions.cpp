// The orthogonal decompositions of the header. The others are sources of their own, to keep each compilation short.
#include <trammel/decompositions.hpp>

namespace Eigen {

using trammel::Mat;
using trammel::Vec;

template class HouseholderQR<Mat>;
template class ColPivHouseholderQR<Mat>;
template class CompleteOrthogonalDecomposition<Mat>;
template void ColPivHouseholderQR<Mat>::_solve_impl(const Vec&, Vec&) const;
template void CompleteOrthogonalDecomposition<Mat>::_solve_impl(const Vec&, Vec&) const;
template void CompleteOrthogonalDecomposition<Mat>::_solve_impl(const Mat&, Mat&) const;

}  // namespace Eigen

namespace trammel {

Mat first_columns_of_q(const Eigen::ColPivHouseholderQR<Mat>& qr, Eigen::Index count) {
  return qr.householderQ() * Mat::Identity(qr.rows(), count);
}

Mat last_columns_of_q(const Eigen::ColPivHouseholderQR<Mat>& qr, Eigen::Index count) {
  Mat basis = Mat::Identity(qr.rows(), qr.rows()).rightCols(count);
  basis.applyOnTheLeft(qr.householderQ());
  return basis;
}

}  // namespace trammel
