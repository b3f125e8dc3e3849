#include "linear/kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/eps.hpp"
#include "linear/dense/orthonormal.hpp"
#include "linear/dense/refinement.hpp"
#include "linear/dense/row_products.hpp"
#include "linear/saddle_point.hpp"

namespace trammel::numerics {

namespace {

// If the parts of multipliers in the rows' accelerations are this many times larger than their sum, their digits are
// lost in it: a light body between heavy ones.
constexpr double cancelling = 1e6;

// The pivots of G M^-1 G^T relative to its diagonal are squares of those sines, for each row against the rows before.
// They are only an early warning; the decomposition decides.
bool pivots_are_safe(const Cholesky& factors, const Mat& matrix, double tolerance) {
  const double safe = 100 * tolerance * tolerance;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    if (!(factors.pivot(i) * factors.pivot(i) > safe * matrix(i, i))) return false;
  return true;
}

// Rows with columns of angles replaced by displacements at their levers; other columns longer than one are shortened to
// one.
struct WithoutLevers {
  Mat G;
  double longest = 1;  // [m] of unknown levers, and the least value of others

  WithoutLevers(const Mat& rows, const Levers& levers) : G(rows) {
    if (G.rows() == 0) return;
    if (levers) G = G * levers().cwiseInverse().asDiagonal();
    for (Eigen::Index j = 0; j < G.cols(); ++j) {
      const double lever = std::max(1.0, G.col(j).lpNorm<Eigen::Infinity>());
      if (lever > 1) G.col(j) /= lever;
      if (!levers) longest = std::max(longest, lever);
    }
  }
  // Violations of rows are smaller relative to longer levers.
  double tolerance(double of_rows) const { return std::max(rank_tolerance_at(0), of_rows / longest); }
};

// Decomposition of the rows scaled to length one, whose pivots are sines of angles to the rows before: masses, units
// and the lengths of rows near a singular position must not make independent rows look alike. Pivoting needs at least
// one column: a system without velocities gets a column of zeros, which has the same range.
Eigen::ColPivHouseholderQR<Mat> decomposed(const WithoutLevers& rows, const Vec& lengths, double tolerance) {
  Mat unit = Mat::Zero(rows.G.rows(), std::max<Eigen::Index>(rows.G.cols(), 1));
  unit.leftCols(rows.G.cols()) = rows.G;
  for (Eigen::Index i = 0; i < unit.rows(); ++i)
    if (lengths[i] > 0) unit.row(i) /= lengths[i];
  Eigen::ColPivHouseholderQR<Mat> qr(unit.rows(), unit.cols());
  qr.setThreshold(rows.tolerance(tolerance));
  qr.compute(unit);
  return qr;
}

// A basis of the range of G, nc x rank; without columns if the rows are all 0.
Mat range_of_rows(const Mat& G, double tolerance, const Levers& levers) {
  const WithoutLevers rows(G, levers);
  const Vec lengths = rows.G.rowwise().norm();
  const Eigen::ColPivHouseholderQR<Mat> qr = decomposed(rows, lengths, tolerance);
  return lengths.asDiagonal() * first_columns_of_q(qr, qr.rank());
}

}  // namespace

double rank_tolerance_at(double violation) {
  return std::clamp(10 * violation, least_rank_tolerance, largest_rank_tolerance);
}

Eigen::Index rank_of_rows(const Mat& G, double tolerance, const Levers& levers) {
  const WithoutLevers rows(G, levers);
  return decomposed(rows, rows.G.rowwise().norm(), tolerance).rank();
}

Mat MassKkt::range_of(const Mat& G, double tolerance) const {
  return range_of_rows(G, tolerance, levers_);
}

Mat IterationKkt::range_of(const Mat& G, double tolerance) const {
  return range_of_rows(G, tolerance, levers_);
}

template <class Factors, class Masses>
bool MassKkt::factorise_by(const Masses& M, const Mat& G, const Mat& W, double rank_tolerance) {
  if (!std::holds_alternative<Factors>(mass_)) mass_.emplace<Factors>();
  if (!std::get<Factors>(mass_).compute(M)) return false;
  change_rows(G, W, rank_tolerance);
  return true;
}

bool MassKkt::factorise(const Mat& M, const Mat& G, const Mat& W, double rank_tolerance) {
  return factorise_by<Cholesky>(M, G, W, rank_tolerance);
}

bool MassKkt::factorise(const Eigen::SparseMatrix<double>& M, const Mat& G, const Mat& W, double rank_tolerance) {
  return factorise_by<SparseCholesky>(M, G, W, rank_tolerance);
}

void MassKkt::change_rows(const Mat& G, const Mat& W, double rank_tolerance) {
  redundant_ = false;
  coupled_ = &W != &G;
  B_ = G;
  if (G.rows() == 0) return;
  with_mass([&](auto& mass) { mass.solve_lower_of_rows(B_); });
  if (coupled_) return complement(G, W, rank_tolerance);
  multiply_rows(B_, B_, schur_);
  redundant_ = !schur_cholesky_.compute(schur_) || !pivots_are_safe(schur_cholesky_, schur_, rank_tolerance);
  if (redundant_) merge_rows(G, rank_tolerance);
}

// A decomposition with pivoting leaves U uncertain by the deviations of dependent rows, differently from call to call.
// The accelerations would then be no smooth function of the state, and a Runge-Kutta method would have second order. A
// step of the power method, which squares that uncertainty, takes it to round-off.
void MassKkt::merge_rows(const Mat& G, double rank_tolerance) {
  merged_ = orthonormal(schur_ * range_of(G, rank_tolerance));
  if (merged_.cols() == 0) return;
  cod_.setThreshold(Eigen::Default);
  const Mat merged_rows = B_.transpose() * merged_;
  cod_.compute(merged_rows);
}

// The pivots are of the order of the squares of those sines, or of their round-off.
void MassKkt::complement(const Mat& G, const Mat& W, double rank_tolerance) {
  constexpr double round_off = 1e-10;
  const double dependent = rank_tolerance * rank_tolerance;
  C_ = W;
  with_mass([&](auto& mass) { mass.solve_lower_of_rows(C_); });
  multiply_rows(B_, C_, schur_);
  schur_lu_.compute(schur_);
  least_pivot_ = std::max(round_off, 100 * dependent);
  redundant_ = schur_lu_.has_small_pivot(schur_, least_pivot_);
  if (!redundant_) return;
  const bool merged = merge_coupled_rows(G, rank_tolerance);
  if (merged_.cols() == 0) return;
  cod_.setThreshold(merged ? round_off : std::max(round_off, dependent));
  const Mat merged_schur = merged_.transpose() * schur_ * merged_;
  cod_.compute(merged_schur);
}

// y = U z, as with W = G. Other multipliers that solve the equations exert other forces W^T y if W depends on them: the
// friction of a hinge, one of two that repeat each other's rows, would follow from the reactions that it causes. False:
// the rows are independent.
bool MassKkt::merge_coupled_rows(const Mat& G, double rank_tolerance) {
  const Mat range = range_of(G, rank_tolerance);
  const bool independent = range.cols() == G.rows();
  Mat gram;
  multiply_rows(B_, B_, gram);
  if (independent)  // singular by friction: rows at length one, so that units do not matter
    merged_ = gram.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  else
    merged_ = orthonormal(gram * range);
  return !independent;
}

void MassKkt::find_signs(BlockSigns& signs) const {
  signs.clear();
  if (coupled_ && B_.rows() > 0) signs.find(schur_, schur_lu_, least_pivot_);
}

bool MassKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  x = b;
  y.resize(B_.rows());
  if (B_.rows() == 0)
    with_mass([&](auto& mass) { mass.solve(x); });
  else
    solve_with_rows(c, x, y);
  return x.allFinite() && y.allFinite();
}

// From z = L^-1 b:  z := z - B^T y,  B z = c. A second correction follows if the first one lost digits.
void MassKkt::hold_rows(const Vec& c, Vec& z, Vec& y) {
  struct Equations {
    MassKkt& kkt;
    const Vec& c;
    Vec &z, &y;
    double missed = 0;
    int corrections = 0;
    double residual() {
      kkt.w_ = -c;
      add_rows_product(1, kkt.B_, z, kkt.w_);
      return missed = kkt.w_.lpNorm<Eigen::Infinity>();
    }
    double correction() {
      kkt.schur_cholesky_.solve(kkt.w_);
      const bool cancels = kkt.schur_.diagonal().cwiseProduct(kkt.w_).lpNorm<Eigen::Infinity>() > cancelling * missed;
      return ++corrections == 1 && cancels ? 1 : 0;
    }
    void apply() {
      y += kkt.w_;
      add_transposed_product(-1, kkt.B_, kkt.w_, z);
    }
  };
  y.setZero();
  const double left =
      refine(Equations{*this, c, z, y}, {.most = 2, .enough = 0, .falls = std::numeric_limits<double>::infinity()})
          .residual;
  if (!std::isfinite(left)) y.setConstant(std::numeric_limits<double>::quiet_NaN());
}

// The same for the combinations that replace redundant rows. Rows that are all 0 leave z unchanged.
void MassKkt::hold_merged_rows(const Vec& c, Vec& z, Vec& y) {
  if (merged_.cols() == 0) {
    y.setConstant(schur_.allFinite() && c.allFinite() ? 0 : std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const Vec merged_c = merged_.transpose() * c, particular = solve_transposed(cod_, merged_c);
  const Vec left = z - particular;
  y = merged_ * cod_.solve(left);
  add_transposed_product(-1, B_, y, z);
}

// Rows that are all 0 have no multipliers.
void MassKkt::solve_merged(Vec& y) const {
  if (merged_.cols() == 0)
    y.setZero();
  else
    y = merged_ * cod_.solve(merged_.transpose() * w_);
}

// From x = b. Before the last line x is z = L^T x:  z = L^-1 b - B^T y,  B z = c;  or with C for the first B.
void MassKkt::solve_with_rows(const Vec& c, Vec& x, Vec& y) {
  with_mass([&](auto& mass) { mass.solve_lower(x); });
  if (coupled_) {
    w_ = -c;
    add_rows_product(1, B_, x, w_);
    if (redundant_)
      solve_merged(y);
    else
      schur_lu_.solve(w_, y);
    add_transposed_product(-1, C_, y, x);
  } else if (redundant_) {
    hold_merged_rows(c, x, y);
  } else {
    hold_rows(c, x, y);
  }
  with_mass([&](auto& mass) { mass.solve_transposed(x); });
}

Mat& IterationKkt::begin(Eigen::Index nv, Eigen::Index nc) {
  nv_ = nv;
  full_.setZero(nv + nc, nv + nc);
  return full_;
}

bool IterationKkt::factorise(const Mat& W, const Mat& G, double rank_tolerance) {
  const auto nc = G.rows();
  if (nc > 0) {
    full_.topRightCorner(nv_, nc) = W.transpose();
    full_.bottomLeftCorner(nc, nv_) = G;
  }
  redundant_ = singular_ = false;
  finite_ = true;
  if (full_.rows() == 0) return true;
  lu_.compute(full_);
  // Dependent rows show in the columns of W. This is only an early warning; the decomposition of the rows decides.
  if (lu_.has_small_pivot(full_, 100 * rank_tolerance, nv_)) {
    finite_ = full_.allFinite();
    if (!finite_) return false;
    redundant_ = merge_rows(W, G, rank_tolerance);
    if (full_.rows() == 0) return true;
    if (redundant_) lu_.compute(full_);
  }
  singular_ = lu_.has_small_pivot(full_, 8 * eps);
  finite_ = !singular_ || full_.allFinite();
  if (singular_ && finite_) {
    cod_.setThreshold(Eigen::Default);
    cod_.compute(full_);
  }
  return finite_;
}

// False: the rows are independent.
bool IterationKkt::merge_rows(const Mat& W, const Mat& G, double rank_tolerance) {
  const Mat range = range_of(G, rank_tolerance);
  const auto rank = range.cols();
  if (rank == G.rows()) return false;
  merged_ = orthonormal(range);
  Mat small = Mat::Zero(nv_ + rank, nv_ + rank);
  small.topLeftCorner(nv_, nv_) = full_.topLeftCorner(nv_, nv_);
  small.topRightCorner(nv_, rank) = W.transpose() * merged_;
  small.bottomLeftCorner(rank, nv_) = merged_.transpose() * G;
  full_.swap(small);
  return true;
}

bool IterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (!finite_ || !c.allFinite()) return false;
  const auto rows = redundant_ ? merged_.cols() : c.size();
  if (rows == 0 && nv_ > 0 && !singular_) {
    lu_.solve(b, x);
    y.setZero(c.size());
    return x.allFinite();
  }
  right_.resize(nv_ + rows);
  right_.head(nv_) = b;
  if (redundant_)
    right_.tail(rows).noalias() = merged_.transpose() * c;
  else
    right_.tail(rows) = c;
  if (right_.size() == 0) {
    solution_.resize(0);
  } else if (!singular_) {
    lu_.solve(right_, solution_);
  } else {
    if (!right_.allFinite()) return false;
    solution_ = cod_.solve(right_);
    // A least-squares solution with a residual is no solution, unless the residual is round-off of positions of the
    // order of 1.
    const Vec residual = full_ * solution_ - right_;
    const double S = full_.topLeftCorner(nv_, nv_).lpNorm<Eigen::Infinity>();
    const double G = std::max(1.0, full_.bottomLeftCorner(rows, nv_).lpNorm<Eigen::Infinity>());
    const bool round_off = residual.head(nv_).norm() <= round_off_of_positions * S &&
                           residual.tail(rows).norm() <= round_off_of_positions * G;
    if (!(residual.norm() <= solved_share * right_.norm() || round_off)) return false;
  }
  x = solution_.head(nv_);
  if (redundant_)
    y = merged_ * solution_.tail(rows);
  else
    y = solution_.tail(rows);
  return solution_.allFinite();
}

}  // namespace trammel::numerics
