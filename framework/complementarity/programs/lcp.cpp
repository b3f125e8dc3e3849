#include "complementarity/programs/lcp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "linear/dense/decompositions.hpp"

namespace trammel::complementarity {
namespace {

// Entries of a column that are no pivots, and ratios that are equal, but for round-off of earlier pivots.
constexpr double no_pivot = 1e-11, same_ratio = 1e-10;
// Of the least number in q: every ratio is then another one, so that degenerate problems cannot cycle.
constexpr double perturbation = 1e-8, round_off = 1e-14;
constexpr int pivots_to_renew = 40;

// Between 1 and 2, in no order.
double irregular(int i) {
  constexpr double golden = 0.6180339887498949;
  return 1 + std::fmod((i + 1) * golden, 1.0);
}

// Columns of the tableau: w (0..n-1), z (n..2n-1), the covering variable z0 (2n), right side, perturbed right side.
class Tableau {
 public:
  Tableau(const Mat& M, const Vec& q) : n_(int(q.size())), first_(n_, 2 * n_ + 3), basis_(std::size_t(n_)) {
    first_.setZero();
    first_.leftCols(n_).setIdentity();
    first_.middleCols(n_, n_) = -M;
    first_.col(covering()).setConstant(-1);
    first_.col(right()) = first_.col(perturbed()) = q;
    const double size = std::max(-perturbation * q.minCoeff(), round_off * q.lpNorm<Eigen::Infinity>());
    for (int i = 0; i < n_; ++i) first_(i, perturbed()) += size * irregular(i), basis_[std::size_t(i)] = i;
    rows_ = first_;
  }

  int covering() const { return 2 * n_; }
  int complement(int column) const { return column < n_ ? column + n_ : column - n_; }
  const std::vector<int>& basis() const { return basis_; }

  // The row that leaves when `column` enters: of the least ratio, of equal ones that with the largest pivot; the
  // covering variable before all others, for that ends the method. -1: none, a ray.
  int leaving_row(int column) const {
    const double least_pivot = no_pivot * std::max(1.0, rows_.col(column).lpNorm<Eigen::Infinity>());
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i)
      if (rows_(i, column) > least_pivot) least = std::min(least, ratio(i, column));
    int best = -1;
    for (int i = 0; i < n_; ++i) {
      if (!(rows_(i, column) > least_pivot)) continue;
      if (ratio(i, column) > least * (1 + same_ratio)) continue;
      if (basis_[std::size_t(i)] == covering()) return i;
      if (best < 0 || rows_(i, column) > rows_(best, column)) best = i;
    }
    return best;
  }

  // The first pivot brings z0 in at the most negative right side; -1: there is none.
  int first_row() const {
    Eigen::Index row = 0;
    return rows_.col(perturbed()).minCoeff(&row) < 0 ? int(row) : -1;
  }

  // Returns the variable that left.
  int pivot(int row, int column) {
    rows_.row(row) /= rows_(row, column);
    for (int i = 0; i < n_; ++i) {
      if (i == row) continue;
      const double factor = rows_(i, column);
      if (factor != 0) rows_.row(i) -= factor * rows_.row(row);
      rows_(i, column) = 0;
    }
    const int left = basis_[std::size_t(row)];
    basis_[std::size_t(row)] = column;
    if (++pivots_ % pivots_to_renew == 0) renew();
    return left;
  }

  bool finite() const { return rows_.allFinite(); }
  double value(int row) const { return rows_(row, right()); }

 private:
  int right() const { return 2 * n_ + 1; }
  int perturbed() const { return 2 * n_ + 2; }
  // No right side is negative but for round-off.
  double ratio(int i, int column) const { return std::max(0.0, rows_(i, perturbed())) / rows_(i, column); }

  // From the beginning, without the round-off of the pivots.
  void renew() {
    const Mat basis = first_(Eigen::all, basis_);
    const Eigen::PartialPivLU<Mat> lu(basis);
    rows_ = lu.solve(first_);
    for (int i = 0; i < n_; ++i) rows_.col(basis_[std::size_t(i)]) = Vec::Unit(n_, i);
  }

  int n_, pivots_ = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> first_, rows_;  // pivots work on rows
  std::vector<int> basis_;
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
  if (n == 1) {  // one contact, nearly always
    if (!(M(0, 0) > 0)) return LcpOutcome::no_solution;
    z[0] = -q[0] / M(0, 0);
    return LcpOutcome::solved;
  }
  Tableau tableau(M, q);
  const int first = tableau.first_row();
  if (first < 0) {  // below 0 by round-off alone
    w = q.cwiseMax(0);
    return LcpOutcome::solved;
  }
  int entering = tableau.complement(tableau.pivot(first, tableau.covering()));
  const int limit = 100 * n + 100;
  for (int pivots = 0; pivots < limit; ++pivots) {
    const int row = tableau.leaving_row(entering);
    if (row < 0) return LcpOutcome::no_solution;
    const int left = tableau.pivot(row, entering);
    if (!tableau.finite()) return LcpOutcome::gave_up;
    if (left == tableau.covering()) {
      for (int i = 0; i < n; ++i)
        if (tableau.basis()[std::size_t(i)] >= n && tableau.basis()[std::size_t(i)] < 2 * n)
          z[tableau.basis()[std::size_t(i)] - n] = std::max(0.0, tableau.value(i));
      polish(M, q, z);
      w = M * z + q;
      for (int i = 0; i < n; ++i)
        if (z[i] > 0) w[i] = 0;  // complementary by construction; what is left is round-off
      return LcpOutcome::solved;
    }
    entering = tableau.complement(left);
  }
  return LcpOutcome::gave_up;
}

}  // namespace trammel::complementarity
