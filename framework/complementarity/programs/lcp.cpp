#include "complementarity/programs/lcp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

// Relative: entries of a column that are no pivots, and ratios that are equal, up to round-off of earlier pivots.
constexpr double no_pivot = 1e-11, same_ratio = 1e-10;
// Relative to the least number in q: makes all ratios different, so that degenerate problems cannot cycle.
constexpr double perturbation = 1e-8, round_off = 1e-14;
constexpr int pivots_to_renew = 40;

// Irregular numbers between 1 and 2.
double irregular(int i) {
  constexpr double golden = 0.6180339887498949;
  return 1 + std::fmod((i + 1) * golden, 1.0);
}

// The basic variables as functions of the others. Variables are numbered w (0..n-1), z (n..2n-1) and the covering
// variable z0 (2n). A row for each basic one; a column for each of the n + 1 others, then the right side and the
// perturbed right side.
class Tableau {
 public:
  Tableau(const Mat& M, const Vec& q)
      : M_(M),
        n_(q.size()),
        rows_(n_, n_ + 3),
        sides_(n_, 2),
        basis_(std::size_t(n_)),
        columns_(std::size_t(n_) + 1),
        column_of_(2 * std::size_t(n_) + 1, -1) {
    const double size = std::max(-perturbation * q.minCoeff(), round_off * q.lpNorm<Eigen::Infinity>());
    for (Index i = 0; i < n_; ++i) {
      sides_.row(i) << q[i], q[i] + size * irregular(int(i));
      basis_[std::size_t(i)] = int(i);
    }
    for (Index j = 0; j <= n_; ++j) place(int(n_ + j), j);
    rows_ << -M, Vec::Constant(n_, -1), sides_;
  }

  int covering() const { return 2 * int(n_); }
  int complement(int variable) const { return variable < n_ ? variable + int(n_) : variable - int(n_); }
  const std::vector<int>& basis() const { return basis_; }

  // The row that leaves when `variable` enters: that with the least ratio; among equal ratios the one with the largest
  // pivot; the covering variable before all others, because that ends the method. -1: none, a ray.
  int leaving_row(int variable) {
    entering_ = rows_.col(column_of_[std::size_t(variable)]);
    const double least_pivot = no_pivot * std::max(1.0, entering_.lpNorm<Eigen::Infinity>());
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < n_; ++i)
      if (entering_[i] > least_pivot) least = std::min(least, ratio(i));
    Index best = -1;
    for (Index i = 0; i < n_; ++i) {
      if (!(entering_[i] > least_pivot)) continue;
      if (ratio(i) > least * (1 + same_ratio)) continue;
      if (basis_[std::size_t(i)] == covering()) return int(i);
      if (best < 0 || entering_[i] > entering_[best]) best = i;
    }
    return int(best);
  }

  // The first pivot brings z0 in at the most negative right side; -1: there is none.
  int first_row() const {
    Index row = 0;
    return rows_.col(perturbed()).minCoeff(&row) < 0 ? int(row) : -1;
  }

  // Exchanges the variable with that of the row, which is returned. Decisions use only the entering column and the
  // right sides; if these are not finite the method ends (`finite`).
  int pivot(int row, int variable) {
    const Index column = column_of_[std::size_t(variable)];
    entering_ = rows_.col(column);
    const double by = entering_[row];
    rows_.row(row) /= by;
    rows_(row, column) = 1 / by;
    for (Index i = 0; i < n_; ++i) {
      if (i == row || entering_[i] == 0) continue;
      rows_(i, column) = 0;
      rows_.row(i) -= entering_[i] * rows_.row(row);
    }
    const int left = std::exchange(basis_[std::size_t(row)], variable);
    column_of_[std::size_t(variable)] = -1;
    place(left, column);
    if (++pivots_ % pivots_to_renew == 0) renew();
    return left;
  }

  bool finite() const { return entering_.allFinite() && rows_.rightCols(2).allFinite(); }
  double value(int row) const { return rows_(row, n_ + 1); }

 private:
  using Index = Eigen::Index;
  Index perturbed() const { return n_ + 2; }
  // A negative right side is round-off.
  double ratio(Index i) const { return std::max(0.0, rows_(i, perturbed())) / entering_[i]; }
  void place(int variable, Index column) {
    columns_[std::size_t(column)] = variable;
    column_of_[std::size_t(variable)] = column;
  }

  // The column of a variable in  w - M z - z0 = q.
  Vec original(int variable) const {
    if (variable == covering()) return Vec::Constant(n_, -1);
    return variable < n_ ? Vec(Vec::Unit(n_, variable)) : Vec(-M_.col(variable - n_));
  }

  // Recomputes the tableau from the original problem, without the round-off of the pivots: the equations of non-basic w
  // give the basic z, the other equations the basic w.
  void renew() {
    std::vector<Index> of_z, of_w, left, equations;  // rows of basic z and w; equations without and with a basic w
    std::vector<bool> basic(std::size_t(n_), false);
    for (Index i = 0; i < n_; ++i) {
      const int variable = basis_[std::size_t(i)];
      if (variable >= n_)
        of_z.push_back(i);
      else
        of_w.push_back(i), equations.push_back(variable), basic[std::size_t(variable)] = true;
    }
    for (Index i = 0; i < n_; ++i)
      if (!basic[std::size_t(i)]) left.push_back(i);
    Mat right(n_, n_ + 3), of_basic(n_, Index(of_z.size()));
    for (Index j = 0; j <= n_; ++j) right.col(j) = original(columns_[std::size_t(j)]);
    right.rightCols(2) = sides_;
    for (std::size_t k = 0; k < of_z.size(); ++k) of_basic.col(Index(k)) = original(basis_[std::size_t(of_z[k])]);
    const Mat equations_of_z = of_basic(left, Eigen::all), right_of_z = right(left, Eigen::all);
    const Mat z = Eigen::PartialPivLU<Mat>(equations_of_z).solve(right_of_z);
    const Mat taken = of_basic(equations, Eigen::all) * z;
    rows_(of_z, Eigen::all) = z;
    rows_(of_w, Eigen::all) = right(equations, Eigen::all) - taken;
  }

  const Mat& M_;
  Index n_;
  int pivots_ = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;  // pivots work on rows
  Mat sides_;
  std::vector<int> basis_, columns_;  // the variable of each row, and of each column
  std::vector<Index> column_of_;      // of each variable; -1: it is basic
  Vec entering_;
};

// Solves again on the set found, M_BB z_B = -q_B, which removes the round-off of the pivots; kept only if it is a
// solution.
void polish(const Mat& M, const Vec& q, Vec& z) {
  std::vector<int> active;
  for (int i = 0; i < q.size(); ++i)
    if (z[i] > 0) active.push_back(i);
  if (active.empty()) return;
  const Mat M_BB = M(active, active);
  const Vec minus_q = -q(active);
  const Eigen::FullPivLU<Mat> lu(M_BB);
  if (!lu.isInvertible()) return;
  const Vec refined = lu.solve(minus_q);
  if (refined.allFinite() && refined.minCoeff() >= 0) z(active) = refined;
}

}  // namespace

LcpOutcome solve_lcp(const Mat& M, const Vec& q, Vec& z, Vec& w) {
  const int n = int(q.size());
  z.setZero(n);
  w.setZero(n);
  if (!M.allFinite() || !q.allFinite()) return LcpOutcome::gave_up;
  if (n == 0 || q.minCoeff() >= 0) {
    w = q;
    return LcpOutcome::solved;
  }
  if (n == 1) {  // one contact, the usual case
    if (!(M(0, 0) > 0)) return LcpOutcome::no_solution;
    z[0] = -q[0] / M(0, 0);
    return LcpOutcome::solved;
  }
  Tableau tableau(M, q);
  const int first = tableau.first_row();
  if (first < 0) {  // negative by round-off only
    w = q.cwiseMax(0);
    return LcpOutcome::solved;
  }
  int entering = tableau.complement(tableau.pivot(first, tableau.covering()));
  const int limit = 100 * n + 100;
  for (int pivots = 0; pivots < limit; ++pivots) {
    const int row = tableau.leaving_row(entering);
    if (row < 0) return tableau.finite() ? LcpOutcome::no_solution : LcpOutcome::gave_up;
    const int left = tableau.pivot(row, entering);
    if (!tableau.finite()) return LcpOutcome::gave_up;
    if (left == tableau.covering()) {
      for (int i = 0; i < n; ++i)
        if (tableau.basis()[std::size_t(i)] >= n && tableau.basis()[std::size_t(i)] < 2 * n)
          z[tableau.basis()[std::size_t(i)] - n] = std::max(0.0, tableau.value(i));
      polish(M, q, z);
      w = M * z + q;
      for (int i = 0; i < n; ++i)
        if (z[i] > 0) w[i] = 0;  // complementary by construction; the value is round-off
      return LcpOutcome::solved;
    }
    entering = tableau.complement(left);
  }
  return LcpOutcome::gave_up;
}

}  // namespace trammel::complementarity
