#include "linear/sparse/sparse_sum.hpp"

#include <algorithm>

namespace trammel::numerics {

bool have_one_pattern(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B) {
  return A.rows() == B.rows() && A.nonZeros() == B.nonZeros() &&
         std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
         std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

void SparseSum::begin(int n) {
  const bool resized = matrix_.rows() != n;  // then the diagonal has no places, even if nothing is added
  if (resized) {
    matrix_.resize(n, n);
    singles_.clear(), pieces_.clear(), places_.clear(), at_.clear();
  }
  values_ = matrix_.valuePtr();
  std::fill_n(values_, matrix_.nonZeros(), 0.0);
  next_single_ = next_piece_ = 0;
  missing_ = other_ = resized;
}

bool SparseSum::finished() {
  const bool fewer = next_single_ < singles_.size() || next_piece_ < pieces_.size();
  singles_.resize(next_single_);
  pieces_.resize(next_piece_);
  return other_ || fewer;
}

Eigen::Index SparseSum::find(int i, int j) const {
  if (matrix_.nonZeros() == 0) return nowhere;
  const int* const rows = matrix_.innerIndexPtr();
  const int* const last = rows + matrix_.outerIndexPtr()[j + 1];
  const int* const found = std::lower_bound(rows + matrix_.outerIndexPtr()[j], last, i);
  return found != last && *found == i ? found - rows : nowhere;
}

void SparseSum::add_new(int i, int j, double value) {
  singles_.resize(next_single_);
  other_ = true;
  const Eigen::Index at = find(i, j);
  singles_.push_back({i, j, at});
  ++next_single_;
  if (at != nowhere)
    values_[at] += value;
  else
    missing_ = true;
}

bool SparseSum::is(const Piece& piece, const Places& rows, const Places& columns) const {
  if (piece.rows != rows.count || piece.columns != columns.count) return false;
  const int* const known = places_.data() + piece.places;
  bool same = true;
  for (int i = 0; i < rows.count; ++i) same &= known[i] == rows[i];
  for (int j = 0; j < columns.count; ++j) same &= known[rows.count + j] == columns[j];
  return same;
}

// Notes the block as the next and last piece.
void SparseSum::note(const Places& rows, const Places& columns) {
  other_ = true;
  if (next_piece_ < pieces_.size()) {
    places_.resize(pieces_[next_piece_].places), at_.resize(pieces_[next_piece_].at);
    pieces_.resize(next_piece_);
  }
  Piece piece{rows.count, columns.count, 0, places_.size(), at_.size()};
  for (int i = 0; i < rows.count; ++i) places_.push_back(rows[i]);
  for (int j = 0; j < columns.count; ++j) places_.push_back(columns[j]);
  for (int i = 0; i < rows.count; ++i)
    if (i == 0 || rows[i] != rows[i - 1] + 1) places_.push_back(i), ++piece.runs;
  places_.push_back(rows.count);
  at_.resize(at_.size() + std::size_t(piece.runs) * std::size_t(piece.columns), int(nowhere));
  pieces_.push_back(piece);
}

// False: it has entries without a place.
bool SparseSum::look_up(const Piece& piece) {
  const int* const rows = places_.data() + piece.places;
  const int *const columns = rows + piece.rows, *const runs = columns + piece.columns;
  int* at = at_.data() + piece.at;
  for (int j = 0; j < piece.columns; ++j)
    for (int r = 0; r < piece.runs; ++r, ++at) {
      const int first = rows[runs[r]], length = runs[r + 1] - runs[r];
      const Eigen::Index found = find(first, columns[j]);
      // All entries of a run have places if its last one is stored at the right distance.
      const bool whole = found != nowhere && found + length <= matrix_.outerIndexPtr()[columns[j] + 1] &&
                         matrix_.innerIndexPtr()[found + length - 1] == first + length - 1;
      if (!whole) return false;
      *at = int(found);
    }
  return true;
}

void SparseSum::add(const Places& rows, const Places& columns, Matrix::Block block, double c) {
  if (rows.count == 0 || columns.count == 0) return;
  if (next_piece_ == pieces_.size() || !is(pieces_[next_piece_], rows, columns)) {
    note(rows, columns);
    if (!look_up(pieces_.back())) missing_ = true;
  }
  const Piece& piece = pieces_[next_piece_++];
  if (missing_) return;  // the whole sum is repeated
  const int* const runs = places_.data() + piece.places + piece.rows + piece.columns;
  const int* at = at_.data() + piece.at;
  for (int j = 0; j < piece.columns; ++j) {
    const double* const from = block.data() + j * block.outerStride();
    for (int r = 0; r < piece.runs; ++r, ++at) {
      double* const to = values_ + *at;
      const double* const first = from + runs[r];
      const int length = runs[r + 1] - runs[r];
      for (int i = 0; i < length; ++i) to[i] += c * first[i];
    }
  }
}

void SparseSum::scale(const Vec& d) {
  const int *const starts = matrix_.outerIndexPtr(), *const rows = matrix_.innerIndexPtr();
  double* const values = matrix_.valuePtr();
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j)
    for (int k = starts[j]; k < starts[j + 1]; ++k) values[k] *= d(rows[k]) * d(j);
}

void SparseSum::reserve(const Places& rows, const Places& columns) {
  reserved_.push_back({rows.count, columns.count, 0, reserved_places_.size(), 0});
  for (int i = 0; i < rows.count; ++i) reserved_places_.push_back(rows[i]);
  for (int j = 0; j < columns.count; ++j) reserved_places_.push_back(columns[j]);
}

namespace {

// Makes the symmetric n x n pattern of all blocks. `each(f)` calls f(rows, number, columns, number).
template <class Each>
Eigen::SparseMatrix<double> pattern_of(std::size_t n, Each&& each) {
  // By column: the rows that each block couples to it.
  struct Tied {
    const int* with;
    int count;
  };
  std::vector<std::size_t> heads(n + 1, 0);
  each([&](const int* rows, int rows_count, const int* columns, int columns_count) {
    for (int j = 0; j < columns_count; ++j) ++heads[std::size_t(columns[j]) + 1];
    for (int i = 0; i < rows_count; ++i) ++heads[std::size_t(rows[i]) + 1];
  });
  for (std::size_t j = 0; j < n; ++j) heads[j + 1] += heads[j];
  std::vector<Tied> ties(heads.back());
  std::vector<std::size_t> next(heads.begin(), heads.end() - 1);
  each([&](const int* rows, int rows_count, const int* columns, int columns_count) {
    for (int j = 0; j < columns_count; ++j) ties[next[std::size_t(columns[j])]++] = {rows, rows_count};
    for (int i = 0; i < rows_count; ++i) ties[next[std::size_t(rows[i])]++] = {columns, columns_count};
  });

  std::vector<int> starts = {0}, all, column, seen(n, -1);
  for (std::size_t j = 0; j < n; ++j) {
    column.clear();
    const auto take = [&](int i) {
      if (seen[std::size_t(i)] != int(j)) seen[std::size_t(i)] = int(j), column.push_back(i);
    };
    take(int(j));
    for (std::size_t b = heads[j]; b < heads[j + 1]; ++b)
      for (int i = 0; i < ties[b].count; ++i) take(ties[b].with[i]);
    std::sort(column.begin(), column.end());
    all.insert(all.end(), column.begin(), column.end());
    starts.push_back(int(all.size()));
  }
  const auto size = Eigen::Index(n);
  Eigen::SparseMatrix<double> pattern(size, size);
  pattern.resizeNonZeros(Eigen::Index(all.size()));
  std::copy(starts.begin(), starts.end(), pattern.outerIndexPtr());
  std::copy(all.begin(), all.end(), pattern.innerIndexPtr());
  std::fill_n(pattern.valuePtr(), all.size(), 0.0);
  return pattern;
}

}  // namespace

bool SparseSum::fit_pattern() {
  const auto each = [&](auto&& f) {
    for (const Single& single : singles_) f(&single.i, 1, &single.j, 1);
    for (const Piece& p : pieces_) f(places_.data() + p.places, p.rows, places_.data() + p.places + p.rows, p.columns);
    for (const Piece& p : reserved_)
      f(reserved_places_.data() + p.places, p.rows, reserved_places_.data() + p.places + p.rows, p.columns);
  };
  Eigen::SparseMatrix<double> pattern = pattern_of(std::size_t(matrix_.rows()), each);
  if (!missing_ && have_one_pattern(pattern, matrix_)) return false;
  ++patterns_;
  matrix_.swap(pattern);
  for (Single& single : singles_) single.at = find(single.i, single.j);
  for (const Piece& piece : pieces_) look_up(piece);
  return true;
}

}  // namespace trammel::numerics
