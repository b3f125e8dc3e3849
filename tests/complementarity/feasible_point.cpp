#include "feasible_point.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace trammel::complementarity {
namespace {

using Real = long double;
using Table = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;

// Of numbers of the order of 1, that come with errors of 1e-16.
constexpr Real no_pivot = 1e-11L, no_slope = 1e-15L, negligible = 1e-13L;
// Then Bland's rule.
constexpr int pivots_of_steepest_slope = 200;

// Columns: x, then one artificial variable a row (not stored: never enters again), then the right side. Last row: the
// slopes of the sum of the artificial variables.
class FirstPhase {
 public:
  FirstPhase(const Mat& B, const Vec& d) : m_(B.rows()), n_(B.cols()), table_(m_ + 1, n_ + 1), basis_(std::size_t(m_)) {
    for (Index i = 0; i < m_; ++i) {
      const Real sign = d[i] < 0 ? -1 : 1;
      table_.row(i).head(n_) = sign * B.row(i).cast<Real>();
      table_(i, n_) = sign * d[i];
      basis_[std::size_t(i)] = n_ + i;
    }
    table_.row(m_) = -table_.topRows(m_).colwise().sum();
  }

  void solve() {
    for (int pivots = 0; table_(m_, n_) < -negligible; ++pivots) {
      if (pivots > 10000) throw std::runtime_error("the simplex method did not end");
      const auto [row, column] = next_pivot(pivots < pivots_of_steepest_slope);
      if (column < 0) return;
      pivot(row, column);
    }
  }

  Vec point() const {
    Vec x = Vec::Zero(n_);
    for (Index i = 0; i < m_; ++i)
      if (basis_[std::size_t(i)] < n_) x[basis_[std::size_t(i)]] = double(table_(i, n_));
    return x;
  }

 private:
  struct Pivot {
    Index row = -1, column = -1;
  };

  // Of columns that make the sum smaller the first, or the one of steepest slope.
  Pivot next_pivot(bool steepest) const {
    Pivot best;
    for (Index j = 0; j < n_; ++j) {
      if (!(table_(m_, j) < -no_slope)) continue;
      if (best.column >= 0 && !(table_(m_, j) < table_(m_, best.column))) continue;
      const Index row = leaving(j, steepest);
      if (row >= 0) best = {row, j};  // else only round-off is left of the column
      if (best.column >= 0 && !steepest) return best;
    }
    return best;
  }

  // Of rows that reach zero first but for what is negligible (Harris) the largest pivot, or by Bland's rule the
  // variable of the least number.
  Index leaving(Index column, bool largest_pivot) const {
    const auto ratio = [&](Index i, Real slack) {
      return (std::max<Real>(0, table_(i, n_)) + slack) / table_(i, column);
    };
    Real least = std::numeric_limits<Real>::infinity();
    for (Index i = 0; i < m_; ++i)
      if (table_(i, column) > no_pivot) least = std::min(least, ratio(i, negligible));
    Index best = -1;
    for (Index i = 0; i < m_; ++i) {
      if (!(table_(i, column) > no_pivot) || ratio(i, 0) > least) continue;
      const bool better = best < 0 || (largest_pivot ? table_(i, column) > table_(best, column)
                                                     : basis_[std::size_t(i)] < basis_[std::size_t(best)]);
      if (better) best = i;
    }
    return best;
  }

  void pivot(Index row, Index column) {
    table_.row(row) /= table_(row, column);
    for (Index i = 0; i <= m_; ++i)
      if (i != row && table_(i, column) != 0) table_.row(i) -= Real(table_(i, column)) * table_.row(row);
    basis_[std::size_t(row)] = column;
  }

  Index m_, n_;
  Table table_;
  std::vector<Index> basis_;
};

}  // namespace

double feasible_point(const Mat& B, const Vec& d, Vec& x) {
  FirstPhase phase(B, d);
  phase.solve();
  x = phase.point();
  return B.rows() > 0 ? (B * x - d).lpNorm<1>() : 0;
}

}  // namespace trammel::complementarity
