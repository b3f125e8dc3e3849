#include "linear/fronts/frontal_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/refinement.hpp"

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace

void FrontalFactors::measure(const Sparse& A) {
  largest_.setZero(A.cols());
  for (Index j = 0; j < A.cols(); ++j)
    for (auto k = A.outerIndexPtr()[j]; k < A.outerIndexPtr()[j + 1]; ++k)
      largest_(j) = std::max(largest_(j), std::abs(A.valuePtr()[k]));
}

// True if A is symmetric with a positive diagonal. In a sweep over the columns, the upper entries of each column meet
// the lower ones in order.
bool FrontalFactors::may_be_definite(const Sparse& A) {
  constexpr double rounding = 64 * eps;
  const int *const starts = A.outerIndexPtr(), *const rows = A.innerIndexPtr();
  const double* const values = A.valuePtr();
  mirrored_.assign(starts, starts + A.cols());
  for (Index j = 0; j < A.cols(); ++j) {
    int k = mirrored_[std::size_t(j)];  // the upper entries follow
    if (!(values[k] > 0)) return false;
    while (++k < starts[j + 1]) {
      const double other = values[mirrored_[std::size_t(rows[k])]++];
      if (!(std::abs(values[k] - other) <= rounding * std::max(largest_(j), largest_(rows[k])))) return false;
    }
  }
  return true;
}

bool FrontalFactors::factorise(const Sparse& A) {
  measure(A);
  by_cholesky_ = may_be_definite(A) && cholesky_.factorise(pattern_, A, largest_);
  return by_cholesky_ || lu_.factorise(pattern_, A, largest_);
}

void FrontalFactors::substitute(Vec& x) {
  if (by_cholesky_)
    cholesky_.substitute(pattern_, x);
  else
    lu_.substitute(pattern_, x);
}

bool FrontalFactors::solve(const Sparse& A, const Vec& b, Vec& x) {
  struct Equations {
    FrontalFactors& factors;
    const Sparse& A;
    const Vec& b;
    Vec& x;
    // Relative to the largest sum that could have been rounded.
    double residual() {
      Vec& r = factors.residual_;
      r = b;
      r.noalias() -= A * x;
      const double left = r.lpNorm<Eigen::Infinity>();
      if (!(left > 0)) return left;
      return left / (factors.largest_.cwiseProduct(x).lpNorm<Eigen::Infinity>() + b.lpNorm<Eigen::Infinity>());
    }
    double correction() { return factors.substitute(factors.residual_), 1; }
    void apply() { x += factors.residual_; }
  };
  constexpr double round_off = 64 * eps, good = 1e-10;  // relative to the equations
  x = b;
  substitute(x);
  return refine(Equations{*this, A, b, x}, {.most = 10, .enough = round_off}).residual <= good;
}

}  // namespace trammel::numerics
