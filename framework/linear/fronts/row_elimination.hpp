// The rows of a front, eliminated by Householder reflections with column pivoting:
//
//     Q^T [C_F C_B 1] P = [R  *   *   Q_1^T]      columns of F first, the longest first; then those of B, in the rest
//     of the rows,
//                         [0  0  C''  Q_2^T]      where they are: not permuted
//
// A column counts while it is longer than the tolerance; rows have length one. C is kept by rows: a reflection then
// combines rows as long as the front is wide, which the processor does by several numbers at once. Q^T is kept as such,
// since a product with it waits for nothing, where one reflection waits for the other.
#pragma once

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

class RowElimination {
 public:
  // C of m rows, `width` numbers each: n of the front, m of the identity, for which there are zeros yet, and zeros.
  RowElimination(double* C, int m, int n) : C_(C), m_(m), n_(n), width_(width(m, n)) {}
  static int width(int m, int n) { return int(padded(n + m)); }  // whole packs

  struct Rank {
    int pivots = 0, passed = 0;  // rows that tell of F, and of the others those that tell of B; the rest tell nothing
  };
  // The first F columns; `columns`: where each came from. `scratch`: 2 width numbers.
  Rank run(int F, double tolerance, int* columns, double* scratch);

 private:
  double* row(int i) const { return C_ + i * width_; }
  int eliminate(int first, int last, int begin, double tolerance, int* columns, double* scratch);
  void bring_forward(int j, int first, int* columns);
  void measure(int begin, int first, int last, double* squares) const;
  double square_of(int column, int begin) const;
  void reflect(int j, int begin, double norm, double* scratch);

  double* C_;
  int m_, n_, width_, F_ = 0;
};

}  // namespace trammel::numerics
