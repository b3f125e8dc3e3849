#include "linear/frontal_iteration_kkt.hpp"

#include <cmath>

namespace trammel::numerics {

namespace {

// The power of two nearest to 1/size.
double inverse_power(double size) {
  int exponent = 0;
  if (!(size > 0) || !std::isfinite(size)) return 1;
  std::frexp(size, &exponent);
  return std::ldexp(1.0, 1 - exponent);
}

double inverse_root_power(double size) {
  int exponent = 0;
  if (!(size > 0) || !std::isfinite(size)) return 1;
  std::frexp(size, &exponent);
  return std::ldexp(1.0, -exponent / 2);
}

}  // namespace

// D scales by the largest entry of each column of S, E by that of each column of D W^T.
void FrontalIterationKkt::find_scale() {
  const Eigen::SparseMatrix<double>& A = full_.matrix();
  const int *const starts = A.outerIndexPtr(), *const rows = A.innerIndexPtr();
  const double* const values = A.valuePtr();
  scale_.resize(A.cols());
  for (int j = 0; j < int(A.cols()); ++j) {
    double largest = 0;
    for (int k = starts[j]; k < starts[j + 1] && rows[k] < nv_; ++k)
      largest = std::max(largest, std::abs(values[k]) * (j < nv_ ? 1 : scale_(rows[k])));
    scale_(j) = j < nv_ ? inverse_root_power(largest) : inverse_power(largest);
  }
}

bool FrontalIterationKkt::factorise_sum() {
  find_scale();
  full_.scale(scale_);
  const Eigen::SparseMatrix<double>& A = full_.matrix();
  if (analysed_ != full_.patterns() || !fronts_.fits(A)) {
    fronts_.analyse(A);
    analysed_ = full_.patterns();
  }
  finite_ = true;
  return fronts_.factorise(A);
}

// Dependent rows give small pivots in their columns. This is only an early warning; the decomposition of the rows
// decides.
bool FrontalIterationKkt::pivots_are_safe() const {
  for (Eigen::Index j = nv_; j < scale_.size(); ++j)
    if (!(std::abs(fronts_.pivot(j)) > safe_pivot_ * fronts_.largest(j))) return false;
  return true;
}

void FrontalIterationKkt::fall_back() {
  by_fronts_ = false;
  full_.scale(scale_.cwiseInverse());
  finite_ = full_.matrix().coeffs().allFinite();
  if (finite_) fallback_.factorise(full_.matrix(), nv_);
}

bool FrontalIterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (by_fronts_) {
    right_.resize(b.size() + c.size());
    right_ << b, c;
    right_.array() *= scale_.array();
    if (fronts_.solve(full_.matrix(), right_, solution_)) {
      solution_.array() *= scale_.array();
      x = solution_.head(nv_), y = solution_.tail(c.size());
      return solution_.allFinite();
    }
    if (!right_.allFinite()) return false;
    fall_back();
  }
  return finite_ && fallback_.solve(b, c, x, y);
}

}  // namespace trammel::numerics
