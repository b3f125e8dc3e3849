#include "linear/fronts/row_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

namespace {

// Columns' squares lose digits as the shares of rows above are taken from them: below this part of the longest that was
// measured they are measured anew.
constexpr double digits_left = 1e-4;

}  // namespace

RowElimination::Rank RowElimination::run(int F, double tolerance, int* columns, double* scratch) {
  F_ = F;
  std::iota(columns, columns + n_, 0);
  for (int i = 0; i < m_; ++i) row(i)[n_ + i] = 1;
  const int pivots = eliminate(0, F, 0, tolerance, columns, scratch);
  return {pivots, eliminate(F, n_, pivots, tolerance, nullptr, scratch)};
}

// Of columns first ... last - 1 on the rows from `begin` on, while one is longer than the tolerance; how many.
// `columns`: they come first.
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

// Squares of columns first ... last - 1 on the rows from `begin` on.
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

// Column j on rows begin ... m - 1 becomes (beta, 0 ... 0). v stays in it until all others have been reflected. Rows
// that column j does not meet stay as they are: of masts a quarter.
void RowElimination::reflect(int j, int begin, double norm, double* scratch) {
  double* const along = scratch + padded(n_);
  const int first = std::min(begin, F_);  // nothing in columns before counts there
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
