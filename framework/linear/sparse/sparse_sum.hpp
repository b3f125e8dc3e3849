// A sparse matrix that is summed repeatedly from blocks in much the same order: a mesh, cell by cell.
//
//     A = sum_e P_e^T B_e Q_e       B_e: dense, on some rows and columns of A
//
// The first sum notes the places of each block and where its entries are stored, neighbouring rows together: a cell of
// 16 nodes needs 192 places for 2304 entries. Later sums only compare the rows and columns. From the first block that
// differs from the last sum (contacts move) all blocks are looked up again, and the pattern becomes that of the present
// blocks and the reserved places: it depends on this sum only and not on earlier ones, so that a resumed run eliminates
// in the same order. The pattern is symmetric and includes the diagonal.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

#include <trammel/matrix.hpp>

namespace trammel::numerics {

bool have_one_pattern(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B);

class SparseSum {
 public:
  // `additions()` calls the functions below on this object; it may be run twice. n x n.
  template <class Additions>
  void fill(int n, Additions&& additions) {
    begin(n);
    additions();
    if (!finished() || !fit_pattern()) return;
    begin(n);
    additions();
  }

  // Rows or columns of a block: first + (dofs ? dofs[i] : i).
  struct Places {
    const int* dofs;
    int first, count;
    int operator[](int i) const { return first + (dofs ? dofs[i] : i); }
  };
  void add(const Places& rows, const Places& columns, Matrix::Block block, double c);
  void add(int i, int j, double value) {
    if (next_single_ == singles_.size() || singles_[next_single_].i != i || singles_[next_single_].j != j)
      return add_new(i, j, value);
    const Eigen::Index at = singles_[next_single_++].at;
    if (at != nowhere) values_[at] += value;
  }
  // Reserves these places permanently, whether or not a block is added there.
  void reserve(const Places& rows, const Places& columns);

  // entry(i, j) *= d_i d_j
  void scale(const Vec& d);

  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }
  int patterns() const { return patterns_; }  // number of patterns so far

 private:
  static constexpr Eigen::Index nowhere = -1;
  struct Single {
    int i, j;
    Eigen::Index at;  // in values_
  };
  // Indices in places_: rows, columns, and the first of each run of neighbouring rows, with the end. In at_: where each
  // run is stored, column by column.
  struct Piece {
    int rows, columns, runs;
    std::size_t places, at;
  };

  void begin(int n);
  bool finished();     // false: the same blocks as last time
  bool fit_pattern();  // to the present blocks; false: it fits already
  void add_new(int i, int j, double value);
  void note(const Places& rows, const Places& columns);
  bool look_up(const Piece& piece);
  bool is(const Piece& piece, const Places& rows, const Places& columns) const;
  Eigen::Index find(int i, int j) const;

  Eigen::SparseMatrix<double> matrix_;
  double* values_ = nullptr;
  std::vector<Single> singles_;
  std::vector<Piece> pieces_, reserved_;
  std::vector<int> places_, reserved_places_, at_;
  std::size_t next_single_ = 0, next_piece_ = 0;
  bool missing_ = false;  // an entry has no place
  bool other_ = false;    // a block differs from that of the last sum
  int patterns_ = 0;
};

}  // namespace trammel::numerics
