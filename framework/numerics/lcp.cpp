#include "numerics/lcp.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>

namespace trammel::numerics {
namespace {

// Columns of the tableau: w (0..n-1), z (n..2n-1), the covering variable z0 (2n), right side (2n + 1).
class Tableau {
 public:
  Tableau(const Mat& M, const Vec& q) : n_(int(q.size())), rows_(n_, 2 * n_ + 2), basis_(n_) {
    rows_.setZero();
    rows_.leftCols(n_).setIdentity();
    rows_.middleCols(n_, n_) = -M;
    rows_.col(2 * n_).setConstant(-1);
    rows_.col(2 * n_ + 1) = q;
    for (int i = 0; i < n_; ++i) basis_[i] = i;
    tolerance_ = 64 * std::numeric_limits<double>::epsilon();
  }

  int covering() const { return 2 * n_; }
  int complement(int column) const { return column < n_ ? column + n_ : column - n_; }
  const std::vector<int>& basis() const { return basis_; }

  // The row that leaves when `column` enters, lexicographically smallest ratio; -1: none, a ray.
  int leaving_row(int column) const {
    const double scale = rows_.col(column).cwiseAbs().maxCoeff();
    int best = -1;
    for (int i = 0; i < n_; ++i) {
      if (rows_(i, column) <= tolerance_ * scale) continue;
      if (best < 0 || before(i, best, column)) best = i;
    }
    return best;
  }

  // The first pivot brings z0 in at the most negative right side, lexicographically.
  int first_row() const {
    int best = 0;
    for (int i = 1; i < n_; ++i) {
      const double difference = rows_(i, 2 * n_ + 1) - rows_(best, 2 * n_ + 1);
      if (difference < 0 || (difference == 0 && i > best)) best = i;
    }
    return best;
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
    const int left = basis_[row];
    basis_[row] = column;
    return left;
  }

  bool finite() const { return rows_.allFinite(); }
  double value(int row) const { return rows_(row, 2 * n_ + 1); }

 private:
  // (right side, w columns) of row i over its pivot before that of row j. The covering variable leaves first in a tie of
  // right sides: that ends the method.
  bool before(int i, int j, int column) const {
    const double pi = rows_(i, column), pj = rows_(j, column);
    const double ri = rows_(i, 2 * n_ + 1) / pi, rj = rows_(j, 2 * n_ + 1) / pj;
    const double close = tolerance_ * (std::abs(ri) + std::abs(rj));
    if (std::abs(ri - rj) > close) return ri < rj;
    if (basis_[i] == covering()) return true;
    if (basis_[j] == covering()) return false;
    for (int k = 0; k < n_; ++k) {
      const double difference = rows_(i, k) / pi - rows_(j, k) / pj;
      if (difference != 0) return difference < 0;
    }
    return false;
  }

  int n_;
  Mat rows_;
  std::vector<int> basis_;
  double tolerance_;
};

// Solves again on the set found, M_BB z_B = -q_B, which removes the round-off of the pivots; kept only if it is a solution.
void polish(const Mat& M, const Vec& q, Vec& z) {
  std::vector<int> active;
  for (int i = 0; i < q.size(); ++i)
    if (z[i] > 0) active.push_back(i);
  if (active.empty()) return;
  const Eigen::FullPivLU<Mat> lu(M(active, active));
  if (!lu.isInvertible()) return;
  const Vec refined = lu.solve(-q(active));
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
  int entering = tableau.complement(tableau.pivot(tableau.first_row(), tableau.covering()));
  const int limit = 100 * n + 100;
  for (int pivots = 0; pivots < limit; ++pivots) {
    const int row = tableau.leaving_row(entering);
    if (row < 0) return LcpOutcome::no_solution;
    const int left = tableau.pivot(row, entering);
    if (!tableau.finite()) return LcpOutcome::gave_up;
    if (left == tableau.covering()) {
      for (int i = 0; i < n; ++i)
        if (tableau.basis()[i] >= n && tableau.basis()[i] < 2 * n)
          z[tableau.basis()[i] - n] = std::max(0.0, tableau.value(i));
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

}  // namespace trammel::numerics
