#include "numerics/kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::numerics {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Rows count as dependent when a pivot of G M^-1 G^T is this small against its own row's diagonal: the square of the
// sine of the angle to the rows before it. sqrt(eps) for the sine leaves room for violated position rows (redundant
// rows are dependent only on the manifold) and the decomposition decides the rest.
constexpr double dependent = 1e-10;

bool pivots_are_safe(const Cholesky& factors, const Mat& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    if (!(factors.pivot(i) * factors.pivot(i) > dependent * matrix(i, i))) return false;
  return true;
}

// Redundant rows leave a pivot at round-off of the largest one in a column; unlike scales of S and G do not, because a pivot
// is compared with its own column. Asked of all columns at once is cheaper, and nearly always enough.
bool pivots_are_safe(const Lu& factors, const Mat& matrix) {
  const auto is_safe = [&](Eigen::Index j, double scale) { return std::abs(factors.pivot(j)) > 8 * eps * scale; };
  const double largest = matrix.cwiseAbs().maxCoeff();
  Eigen::Index j = 0;
  while (j < matrix.cols() && (is_safe(j, largest) || is_safe(j, matrix.col(j).cwiseAbs().maxCoeff()))) ++j;
  return j == matrix.cols();
}

}  // namespace

bool MassKkt::factorise(const Mat& M, const Mat& G, const Mat& W) {
  if (!mass_.compute(M)) return false;
  change_rows(G, W);
  return true;
}

void MassKkt::change_rows(const Mat& G, const Mat& W) {
  redundant_ = false;
  coupled_ = &W != &G;
  B_.resize(G.cols(), G.rows());
  if (G.rows() == 0) return;
  B_ = G.transpose();
  mass_.solve_lower(B_);
  schur_.resize(G.rows(), G.rows());
  if (coupled_) return complement(W);
  schur_.noalias() = B_.transpose() * B_;
  redundant_ = !schur_cholesky_.compute(schur_) || !pivots_are_safe(schur_cholesky_, schur_);
  if (!redundant_) return;
  cod_.setThreshold(std::sqrt(eps));
  cod_.compute(B_);
}

void MassKkt::complement(const Mat& W) {
  C_ = W.transpose();
  mass_.solve_lower(C_);
  schur_.noalias() = B_.transpose() * C_;
  schur_lu_.compute(schur_);
  for (Eigen::Index j = 0; j < schur_.cols(); ++j)
    if (!(std::abs(schur_lu_.pivot(j)) > dependent * schur_.col(j).cwiseAbs().maxCoeff())) redundant_ = true;
  if (!redundant_) return;
  cod_.setThreshold(dependent);
  cod_.compute(schur_);
}

// x is z = L^T x before the last line:  z = L^-1 b - B y,  B^T z = c;  or with C for the first B.
void MassKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  x = b;
  mass_.solve_lower(x);
  y.resize(B_.cols());
  if (coupled_ && B_.cols() > 0) {
    w_ = -c;
    w_.noalias() += B_.transpose() * x;
    if (redundant_)
      y = cod_.solve(w_);
    else
      schur_lu_.solve(w_, y);
    x.noalias() -= C_ * y;
  } else if (redundant_) {
    const Vec particular = cod_.transpose().solve(c);
    y = cod_.solve(x - particular);
    x.noalias() -= B_ * y;
  } else if (B_.cols() > 0) {
    y = -c;
    y.noalias() += B_.transpose() * x;
    schur_cholesky_.solve(y);
    x.noalias() -= B_ * y;
  }
  mass_.solve_transposed(x);
}

Mat& IterationKkt::begin(Eigen::Index nv, Eigen::Index nc) {
  nv_ = nv;
  full_.setZero(nv + nc, nv + nc);
  return full_;
}

void IterationKkt::factorise(const Mat& W, const Mat& G) {
  const auto nc = G.rows();
  if (nc > 0) {
    full_.topRightCorner(nv_, nc) = W.transpose();
    full_.bottomLeftCorner(nc, nv_) = G;
  }
  singular_ = false;
  finite_ = true;
  if (full_.rows() == 0) return;
  lu_.compute(full_);
  singular_ = !pivots_are_safe(lu_, full_);
  finite_ = !singular_ || full_.allFinite();
  if (singular_ && finite_) {
    cod_.setThreshold(Eigen::Default);
    cod_.compute(full_);
  }
}

bool IterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  const auto nc = c.size();
  if (!finite_) return false;
  if (nc == 0 && nv_ > 0 && !singular_) {
    lu_.solve(b, x);
    y.resize(0);
    return x.allFinite();
  }
  right_.resize(nv_ + nc);
  right_.head(nv_) = b;
  right_.tail(nc) = c;
  if (right_.size() == 0) {
    solution_.resize(0);
  } else if (!singular_) {
    lu_.solve(right_, solution_);
  } else {
    if (!right_.allFinite()) return false;
    solution_ = cod_.solve(right_);
    // A least-squares answer that leaves a residual is no solution; unless it is the round-off in which redundant rows
    // differ, of positions of the order of 1.
    const Vec residual = full_ * solution_ - right_;
    const double noise = 1e-13, S = full_.topLeftCorner(nv_, nv_).cwiseAbs().maxCoeff();
    const double G = std::max(1.0, full_.bottomLeftCorner(nc, nv_).cwiseAbs().maxCoeff());
    const bool round_off = residual.head(nv_).norm() <= noise * S && residual.tail(nc).norm() <= noise * G;
    if (!(residual.norm() <= 1e-6 * right_.norm() || round_off)) return false;
  }
  x = solution_.head(nv_);
  y = solution_.tail(nc);
  return solution_.allFinite();
}

}  // namespace trammel::numerics
