// The LU and Cholesky decompositions of decompositions.hpp.
#include <trammel/decompositions.hpp>

namespace Eigen {

using trammel::Mat;
using trammel::Vec;

template class FullPivLU<Mat>;
template class PartialPivLU<Mat>;
template class LLT<Mat>;
template class LDLT<Mat>;
template LLT<Mat>& LLT<Mat>::compute(const EigenBase<Mat>&);
template LDLT<Mat>& LDLT<Mat>::compute(const EigenBase<Mat>&);
template void FullPivLU<Mat>::_solve_impl(const Vec&, Vec&) const;
template void LLT<Mat>::_solve_impl(const Vec&, Vec&) const;
template void LLT<Mat>::_solve_impl(const Mat&, Mat&) const;
template void LDLT<Mat>::_solve_impl(const Vec&, Vec&) const;

}  // namespace Eigen
