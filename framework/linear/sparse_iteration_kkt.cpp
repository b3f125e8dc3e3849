#include "linear/sparse_iteration_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/eps.hpp"
#include "linear/dense/refinement.hpp"
#include "linear/sparse/sparse_sum.hpp"

namespace trammel::numerics {

namespace {

// Of S's and G's scales. Large beside its round-off, so that corrections converge; its square root is the singular
// value, relative to the largest, below which rows count as redundant. A chain's own rows must not, whose softest falls
// with the square of their number: among few rows alone soft ones are those of a singular position.
constexpr int long_from = 200;
constexpr double regularisation(int nc) {
  return nc < long_from ? 1e-10 : 1e-12;
}
// Redundant rows part by no more than this where they are violated, the largest rank tolerance of kkt.hpp.
constexpr double parting = 1e-2;

}  // namespace

bool SparseIterationKkt::factorise(const Eigen::SparseMatrix<double>& full, int nv) {
  const bool same_pattern = nv == nv_ && have_one_pattern(full, full_);
  const int nc = int(full.rows()) - nv;
  full_ = full;
  regular_ = full;
  nv_ = nv;
  double S = 0, G = 0;
  for (int j = 0; j < nv; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(full, j); it; ++it)
      (it.row() < nv ? S : G) = std::max(it.row() < nv ? S : G, std::abs(it.value()));
  const double of_rows = S > 0 ? regularisation(nc) * G * G / S : 0;
  eps_ = G > 0 ? of_rows : 1;  // rows that hold nothing have no scale
  for (int i = 0; i < nc; ++i) regular_.coeffRef(nv + i, nv + i) -= eps_;
  regular_.makeCompressed();
  failed_ = redundant_ = soft_ = false;
  if (full.rows() == 0) return true;
  if (!same_pattern) lu_.analyzePattern(regular_);
  lu_.factorize(regular_);
  failed_ = lu_.info() != Eigen::Success;
  if (nc > 0 && nc < long_from && !failed_ && eps_ > 0) judge_rows(nc);
  return !failed_;
}

// eps^2 (C + eps)^-2 y, C = G S^-1 W^T, keeps of y what lies in the rows' null space, and little else. The matrix takes
// (0, -r) to (-S^-1 W^T y, y) with y = (C + eps)^-1 r: the head is what the tail does to x.
void SparseIterationKkt::find_null_part(const Eigen::Ref<const Vec>& y) {
  null_part_.setZero(nv_ + y.size());
  null_part_.tail(y.size()) = y;
  for (int twice = 0; twice < 2; ++twice) {
    null_part_.head(nv_).setZero();
    null_part_ = (-eps_ * lu_.solve(null_part_)).eval();
  }
}

// Whether that part, of entries in no order, changes when it is taken again. It does not where rows are redundant or
// independent.
void SparseIterationKkt::judge_rows(int nc) {
  constexpr double golden = 0.61803398874989485, noticed = 1e-5;
  residual_.resize(nc);
  for (int i = 0; i < nc; ++i) residual_[i] = 1 + std::fmod(i * golden, 1.0);
  const double least = noticed * residual_.norm();
  find_null_part(residual_);
  if (!(null_part_.tail(nc).norm() > least)) return;
  redundant_ = true;
  residual_ = null_part_.tail(nc);
  find_null_part(residual_);
  soft_ = (null_part_.tail(nc) - residual_).norm() > least;
}

// Solutions leave their round-off over eps along the rows' null space, and so do the passes themselves.
// Forces stay balanced where rows depend on others but for a little: x follows.
void SparseIterationKkt::minimise_norm(int nc) {
  constexpr int passes = 2;
  for (int pass = 0; pass < passes; ++pass) {
    find_null_part(solution_.tail(nc));
    solution_ -= null_part_;
  }
}

double SparseIterationKkt::solve_and_refine() {
  struct Equations {
    SparseIterationKkt& kkt;
    double residual() {
      kkt.residual_ = kkt.right_;
      kkt.residual_.noalias() -= kkt.full_ * kkt.solution_;
      return kkt.residual_.norm();
    }
    double correction() { return kkt.correction_ = kkt.lu_.solve(kkt.residual_), ++kkt.solves_, 1; }
    void apply() { kkt.solution_ += kkt.correction_; }
  };
  solution_ = lu_.solve(right_);
  solves_ = 1;
  return refine(Equations{*this}, {.most = 40, .enough = 1e-15 * right_.norm(), .falls = 0.9}).residual;
}

// Soft rows are taken for redundant, all the more the softer they are: c does not ask for them, and y does nothing
// along them.
double SparseIterationKkt::solve_without_soft_rows(int nc) {
  constexpr int passes = 3;  // each leaves of rows with sigma^2 < eps/10 a fifth at most
  for (int i = 0; i < passes; ++i) {
    find_null_part(right_.tail(nc));
    right_.tail(nc) -= null_part_.tail(nc);
  }
  const double left = solve_and_refine();
  for (int i = 0; i < passes; ++i) {
    find_null_part(solution_.tail(nc));
    solution_ -= null_part_;
  }
  return left;
}

bool SparseIterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (failed_ || !b.allFinite() || !c.allFinite()) return false;
  right_.resize(b.size() + c.size());
  right_ << b, c;
  if (right_.size() == 0) return x = b, y = c, true;
  const double left = soft_ ? solve_without_soft_rows(int(c.size())) : solve_and_refine();
  const bool reached = left <= 1e-6 * right_.norm();
  if (reached && redundant_ && !soft_) minimise_norm(int(c.size()));
  x = solution_.head(nv_);
  y = solution_.tail(c.size());
  if (!solution_.allFinite()) return false;
  if (reached) return true;
  // What no x reaches is left: where redundant rows differ, by round-off or as far as Newton's iteration still has to
  // go. Each solution has added it to y, along the rows' null space.
  if (!soft_ && eps_ > 0) y += solves_ / eps_ * residual_.tail(c.size());
  const double of_rows = residual_.tail(c.size()).norm();
  const double of_forces = residual_.head(nv_).norm();
  residual_.head(nv_).setZero();
  right_.noalias() = full_.transpose() * residual_;
  // Reactions larger than what they balance, as near a singular position, leave their round-off.
  const double size = full_.norm(), round_off = 1e-13 * size + 16 * eps * size * y.norm();
  return of_forces <= 1e-6 * b.norm() + round_off && right_.head(nv_).norm() <= parting * of_rows;
}

}  // namespace trammel::numerics
