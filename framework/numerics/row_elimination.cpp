#include "numerics/row_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/small_loops.hpp"

namespace trammel::numerics {

RowElimination::Rank RowElimination::run(int F, double tolerance, int* columns, double* scratch) {
  F_ = F;
  std::iota(columns, columns + n_, 0);
  for (int i = 0; i < m_; ++i) row(i)[n_ + i] = 1;
  const int told = eliminate(0, F, 0, tolerance, columns, scratch);
  return {told, eliminate(F, n_, told, tolerance, nullptr, scratch)};
}

// Of columns first ... last - 1 on the rows from `begin` on, while one is longer than the tolerance; how many. `columns`: they come
// first.
int RowElimination::eliminate(int first, int last, int begin, double tolerance, int* columns, double* scratch) {
  if (begin == m_) return 0;
  double* const squares = scratch;
  std::fill_n(squares, n_, 0.0);
  for (int i = begin; i < m_; ++i)
    for (int j = first; j < last; ++j) squares[j] += row(i)[j] * row(i)[j];
  int at = begin;
  for (; at < m_ && first < last; ++at) {
    int j = int(std::max_element(squares + first, squares + last) - squares);
    if (!(squares[j] > tolerance * tolerance)) break;
    if (columns) {
      bring_forward(j, first, columns);
      std::swap(squares[j], squares[first]);
      j = first++;
    }
    reflect(j, at, scratch);
  }
  return at - begin;
}

void RowElimination::bring_forward(int j, int first, int* columns) {
  if (j == first) return;
  for (int i = 0; i < m_; ++i) std::swap(row(i)[j], row(i)[first]);
  std::swap(columns[j], columns[first]);
}

// Column j on rows begin ... m - 1 becomes (beta, 0 ... 0); the squares of what is left below of each. v stays in column j until all
// others have been reflected.
void RowElimination::reflect(int j, int begin, double* scratch) {
  double *const squares = scratch, *const along = scratch + n_;
  const int first = std::min(begin, F_), n = width_ - first;  // columns before are zero there
  const double head = row(begin)[j], norm = std::sqrt(squares[j]), beta = head > 0 ? -norm : norm;
  const double tau = -1 / (beta * (head - beta));
  row(begin)[j] = head - beta;

  double* const top = row(begin) + first;
  for (int k = 0; k < n; ++k) along[k] = tau * top[j - first] * top[k];
  for (int i = begin + 1; i < m_; ++i) add(n, tau * row(i)[j], row(i) + first, along);
  add(n, -top[j - first], along, top);
  std::fill_n(squares + first, n_ - first, 0.0);
  for (int i = begin + 1; i < m_; ++i) {
    double* const x = row(i) + first;
    add(n, -x[j - first], along, x);
    for (int k = 0; k < n_ - first; ++k) squares[first + k] += x[k] * x[k];
  }
  row(begin)[j] = beta;
  for (int i = begin + 1; i < m_; ++i) row(i)[j] = 0;
  squares[j] = 0;
}

}  // namespace trammel::numerics
