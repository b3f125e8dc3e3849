#include "linear/fronts/row_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

namespace {

// Squares of columns lose digits when the parts of eliminated rows are subtracted: below this part of the longest
// measured one they are computed again.
constexpr double digits_left = 1e-4;

}  // namespace

RowElimination::Rank RowElimination::run(int F, double tolerance, int* columns, double* scratch) {
  F_ = F;
  std::iota(columns, columns + n_, 0);
  for (int i = 0; i < m_; ++i) row(i)[n_ + i] = 1;
  const int pivots = eliminate(0, F, 0, tolerance, columns, scratch);
  return {pivots, eliminate(F, n_, pivots, tolerance, nullptr, scratch)};
}

// Eliminates columns [first, last) from row `begin` on while a column's norm exceeds the tolerance; returns the rank.
// `columns`: their permutation, pivots first.
int RowElimination::eliminate(int first, int last, int begin, double tolerance, int* columns, double* scratch) {
  double* const squares = scratch;
  double safe = 0;
  int at = begin;
  for (; at < m_ && first < last; ++at) {
    const auto longest = [&] { return int(std::max_element(squares + first, squares + last) - squares); };
    int j = at == begin ? first : longest();
    if (at == begin || squares[j] < safe) {
      measure(at, first, last, squares);
      j = longest();
      safe = digits_left * squares[j];
    }
    const double square = square_of(j, at);
    if (!(square > tolerance * tolerance)) break;
    if (columns) {
      bring_forward(j, first, columns);
      std::swap(squares[j], squares[first]);
      j = first++;
    }
    reflect(j, at, std::sqrt(square), scratch);
    for (int k = first; k < last; ++k) squares[k] -= row(at)[k] * row(at)[k];
  }
  return at - begin;
}

// Squares of the norms of columns [first, last) from row `begin` on.
void RowElimination::measure(int begin, int first, int last, double* squares) const {
  std::fill(squares + first, squares + last, 0.0);
  for (int i = begin; i < m_; ++i)
    for (int k = first; k < last; ++k) squares[k] += row(i)[k] * row(i)[k];
}

double RowElimination::square_of(int column, int begin) const {
  double sum = 0;
  for (int i = begin; i < m_; ++i) sum += row(i)[column] * row(i)[column];
  return sum;
}

void RowElimination::bring_forward(int j, int first, int* columns) {
  if (j == first) return;
  for (int i = 0; i < m_; ++i) std::swap(row(i)[j], row(i)[first]);
  std::swap(columns[j], columns[first]);
}

// Reflects column j on rows [begin, m) to (beta, 0 ... 0). v stays in it until all other columns have been reflected.
// Rows in which column j is 0 are skipped: a quarter of them in masts.
void RowElimination::reflect(int j, int begin, double norm, double* scratch) {
  double* const along = scratch + padded(n_);
  const int first = std::min(begin, F_);  // earlier columns are no longer needed there
  double* const top = row(begin);
  const double head = top[j], beta = head > 0 ? -norm : norm, tau = 1 / (beta * (head - beta));
  top[j] = head - beta;

  for (Eigen::Index k = pack_of(first); k < width_; k += pack) pack_at(along + k) = -tau * top[j] * pack_at(top + k);
  for (int i = begin + 1; i < m_; ++i)
    if (const double v = row(i)[j]; v != 0) subtract(tau * v, row(i), along, first, width_);
  subtract(top[j], along, top, first, width_);
  for (int i = begin + 1; i < m_; ++i)
    if (const double v = row(i)[j]; v != 0) subtract(v, along, row(i), first, width_);
  row(begin)[j] = beta;
  for (int i = begin + 1; i < m_; ++i) row(i)[j] = 0;
}

}  // namespace trammel::numerics
