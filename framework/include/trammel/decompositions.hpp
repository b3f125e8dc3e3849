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

extern template class HouseholderQR<trammel::Mat>;
extern template class ColPivHouseholderQR<trammel::Mat>;
extern template class CompleteOrthogonalDecomposition<trammel::Mat>;
extern template class FullPivLU<trammel::Mat>;
extern template class PartialPivLU<trammel::Mat>;
extern template class LLT<trammel::Mat>;
extern template class LDLT<trammel::Mat>;
extern template class SelfAdjointEigenSolver<trammel::Mat>;
extern template class GeneralizedSelfAdjointEigenSolver<trammel::Mat>;
extern template class EigenSolver<trammel::Mat>;

// An instantiation of a class does not instantiate its member templates.
extern template LLT<trammel::Mat>& LLT<trammel::Mat>::compute(const EigenBase<trammel::Mat>&);
extern template LDLT<trammel::Mat>& LDLT<trammel::Mat>::compute(const EigenBase<trammel::Mat>&);
extern template SelfAdjointEigenSolver<trammel::Mat>& SelfAdjointEigenSolver<trammel::Mat>::compute(
    const EigenBase<trammel::Mat>&, int);
extern template EigenSolver<trammel::Mat>& EigenSolver<trammel::Mat>::compute(const EigenBase<trammel::Mat>&, bool);

extern template void ColPivHouseholderQR<trammel::Mat>::_solve_impl(const trammel::Vec&, trammel::Vec&) const;
extern template void CompleteOrthogonalDecomposition<trammel::Mat>::_solve_impl(const trammel::Vec&,
                                                                                trammel::Vec&) const;
extern template void CompleteOrthogonalDecomposition<trammel::Mat>::_solve_impl(const trammel::Mat&,
                                                                                trammel::Mat&) const;
extern template void FullPivLU<trammel::Mat>::_solve_impl(const trammel::Vec&, trammel::Vec&) const;
extern template void LLT<trammel::Mat>::_solve_impl(const trammel::Vec&, trammel::Vec&) const;
extern template void LLT<trammel::Mat>::_solve_impl(const trammel::Mat&, trammel::Mat&) const;
extern template void LDLT<trammel::Mat>::_solve_impl(const trammel::Vec&, trammel::Vec&) const;

}  // namespace Eigen

namespace trammel {

// Columns of the orthogonal factor Q (m x m), m x count. The first ones, as many as the rank, are an orthonormal basis
// of the range of the decomposed matrix; the last ones are a basis of the orthogonal complement.
Mat first_columns_of_q(const Eigen::ColPivHouseholderQR<Mat>& qr, Eigen::Index count);
Mat last_columns_of_q(const Eigen::ColPivHouseholderQR<Mat>& qr, Eigen::Index count);

}  // namespace trammel
