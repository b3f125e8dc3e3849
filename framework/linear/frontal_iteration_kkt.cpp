#include "linear/frontal_iteration_kkt.hpp"

namespace trammel::numerics {

// Dependent rows show in the pivots of their columns. Only a warning, given early; the rows' own decomposition decides.
bool FrontalIterationKkt::rows_are_independent(const Mat& G, double rank_tolerance) const {
  const double safe = 100 * rank_tolerance;
  for (Eigen::Index j = nv_; j < nv_ + G.rows(); ++j)
    if (!(std::abs(fronts_.pivot(j)) > safe * fronts_.largest(j))) return rank_of_rows(G, rank_tolerance) == G.rows();
  return true;
}

void FrontalIterationKkt::factorise_sum(int nv, const Mat& G, double rank_tolerance) {
  nv_ = nv;
  const Eigen::SparseMatrix<double>& A = full_.matrix();
  if (analysed_ != full_.patterns()) {
    fronts_.analyse(A);
    analysed_ = full_.patterns();
  }
  by_fronts_ = fronts_.factorise(A) && rows_are_independent(G, rank_tolerance);
  finite_ = by_fronts_ || A.coeffs().allFinite();
  if (!by_fronts_ && finite_) fallback_.factorise(A, nv_);
}

bool FrontalIterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (!finite_) return false;
  if (by_fronts_) {
    right_.resize(b.size() + c.size());
    right_ << b, c;
    if (fronts_.solve(full_.matrix(), right_, solution_)) {
      x = solution_.head(nv_), y = solution_.tail(c.size());
      return solution_.allFinite();
    }
    if (!right_.allFinite()) return false;
    by_fronts_ = false;
    fallback_.factorise(full_.matrix(), nv_);
  }
  return fallback_.solve(b, c, x, y);
}

}  // namespace trammel::numerics
