#include "linear/sparse_iteration_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/eps.hpp"
#include "linear/dense/refinement.hpp"
#include "linear/saddle_point.hpp"
#include "linear/sparse/sparse_sum.hpp"

namespace trammel::numerics {

namespace {

// eps relative to the scales of S and G. It is large compared with round-off, so that corrections converge; its square
// root is the singular value, relative to the largest, below which rows count as redundant. The rows of a chain must
// not count: their smallest singular value falls with the square of their number, so few and many rows have different
// limits. In systems of few rows small singular values belong to a singular position.
constexpr int long_from = 200;
constexpr double of_few_rows = 1e-10, of_many_rows = 1e-12;
constexpr double regularisation(int nc) {
  return nc < long_from ? of_few_rows : of_many_rows;
}
// Redundant rows that are violated differ by no more.
constexpr double parting = largest_rank_tolerance;
// Corrections of a solution: until the residual is below round-off of the right side, or falls by less than a tenth.
constexpr int most_corrections = 40;
constexpr double below_round_off = 1e-15, falling = 0.9;

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
  eps_ = G > 0 ? of_rows : 1;  // rows that are all 0 have no scale
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

// eps^2 (C + eps)^-2 y with C = G S^-1 W^T: keeps the part of y in the null space of the rows, and little else. The
// matrix maps (0, -r) to (-S^-1 W^T y, y) with y = (C + eps)^-1 r: the head of the solution is the change of x by its
// tail.
void SparseIterationKkt::find_null_part(const Eigen::Ref<const Vec>& y) {
  null_part_.setZero(nv_ + y.size());
  null_part_.tail(y.size()) = y;
  for (int twice = 0; twice < 2; ++twice) {
    null_part_.head(nv_).setZero();
    null_part_ = (-eps_ * lu_.solve(null_part_)).eval();
  }
}

// Does the null part of an irregular y change when it is taken again? It does not if the rows are redundant or
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

// Removes the null part of y: solutions, and the passes themselves, leave their round-off over eps there. x is changed
// accordingly, so that forces stay balanced if rows are only nearly dependent.
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
  return refine(Equations{*this},
                {.most = most_corrections, .enough = below_round_off * right_.norm(), .falls = falling})
      .residual;
}

// Nearly dependent rows count as redundant the more, the smaller their singular value is: their part of c is ignored,
// and y does not act along them.
double SparseIterationKkt::solve_without_soft_rows(int nc) {
  constexpr int passes = 3;  // rows with sigma^2 < eps/10 keep at most a fifth in each
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
  const bool reached = left <= solved_share * right_.norm();
  if (reached && redundant_ && !soft_) minimise_norm(int(c.size()));
  x = solution_.head(nv_);
  y = solution_.tail(c.size());
  if (!solution_.allFinite()) return false;
  if (reached) return true;
  // The part of c that no x reaches: redundant rows differ by round-off, or by the distance that Newton's iteration
  // still has to go. Each solution has added it to y, in the null space of the rows.
  if (!soft_ && eps_ > 0) y += solves_ / eps_ * residual_.tail(c.size());
  const double of_rows = residual_.tail(c.size()).norm();
  const double of_forces = residual_.head(nv_).norm();
  residual_.head(nv_).setZero();
  right_.noalias() = full_.transpose() * residual_;
  // Near a singular position reactions are larger than the forces that they balance, and leave their round-off.
  const double size = full_.norm(), round_off = round_off_of_positions * size + 16 * eps * size * y.norm();
  return of_forces <= solved_share * b.norm() + round_off && right_.head(nv_).norm() <= parting * of_rows;
}

}  // namespace trammel::numerics
