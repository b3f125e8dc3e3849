// Eigen's decompositions of dense matrices, instantiated once, in libtrammel.
//
// Each costs a compiler 5 to 10 s wherever it is used. Sources include this header in place of <Eigen/QR> and the like
// and use the decompositions as usual. It saves time only if neither argument nor result is an expression, such as a
// product, a column or a matrix of fixed size: store it in a Mat or Vec first.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <trammel/types.hpp>

namespace Eigen {

using trammel::Mat;
using trammel::Vec;

extern template class HouseholderQR<Mat>;
extern template class ColPivHouseholderQR<Mat>;
extern template class CompleteOrthogonalDecomposition<Mat>;
extern template class FullPivLU<Mat>;
extern template class PartialPivLU<Mat>;
extern template class LLT<Mat>;
extern template class LDLT<Mat>;
extern template class SelfAdjointEigenSolver<Mat>;
extern template class GeneralizedSelfAdjointEigenSolver<Mat>;
extern template class EigenSolver<Mat>;

// An instantiation of a class does not instantiate its member templates.
extern template LLT<Mat>& LLT<Mat>::compute(const EigenBase<Mat>&);
extern template LDLT<Mat>& LDLT<Mat>::compute(const EigenBase<Mat>&);
extern template SelfAdjointEigenSolver<Mat>& SelfAdjointEigenSolver<Mat>::compute(const EigenBase<Mat>&, int);
extern template EigenSolver<Mat>& EigenSolver<Mat>::compute(const EigenBase<Mat>&, bool);

extern template void ColPivHouseholderQR<Mat>::_solve_impl(const Vec&, Vec&) const;
extern template void CompleteOrthogonalDecomposition<Mat>::_solve_impl(const Vec&, Vec&) const;
extern template void CompleteOrthogonalDecomposition<Mat>::_solve_impl(const Mat&, Mat&) const;
extern template void FullPivLU<Mat>::_solve_impl(const Vec&, Vec&) const;
extern template void LLT<Mat>::_solve_impl(const Vec&, Vec&) const;
extern template void LLT<Mat>::_solve_impl(const Mat&, Mat&) const;
extern template void LDLT<Mat>::_solve_impl(const Vec&, Vec&) const;

}  // namespace Eigen

namespace trammel {

// Columns of the orthogonal factor Q (m x m), m x count. The first ones, as many as the rank, are an orthonormal basis
// of the range of the decomposed matrix; the last ones are a basis of the orthogonal complement.
Mat first_columns_of_q(const Eigen::ColPivHouseholderQR<Mat>& qr, Eigen::Index count);
Mat last_columns_of_q(const Eigen::ColPivHouseholderQR<Mat>& qr, Eigen::Index count);

}  // namespace trammel
