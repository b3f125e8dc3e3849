// The eigenvalue decompositions of decompositions.hpp.
#include <trammel/decompositions.hpp>

namespace Eigen {

using trammel::Mat;
using trammel::Vec;

template class SelfAdjointEigenSolver<Mat>;
template class GeneralizedSelfAdjointEigenSolver<Mat>;
template class EigenSolver<Mat>;

template SelfAdjointEigenSolver<Mat>& SelfAdjointEigenSolver<Mat>::compute(const EigenBase<Mat>&, int);
template EigenSolver<Mat>& EigenSolver<Mat>::compute(const EigenBase<Mat>&, bool);

}  // namespace Eigen
