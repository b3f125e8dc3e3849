// The rows of a front, eliminated by Householder reflections with column pivoting:
//
//     Q^T [C_F C_B 1] P = [R  *   *   Q_1^T]      P: pivots among the columns of F first, the longest first;
//                         [0  0  C''  Q_2^T]      then columns of B are eliminated in the other rows, in place
//
// A column counts while its norm exceeds the tolerance; rows have length one. C is stored by rows: a reflection then
// combines rows as long as the front is wide, in SIMD operations. Q^T is stored explicitly, because its products are
// independent of each other, whereas successive reflections are not.
#pragma once

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

class RowElimination {
 public:
  // C: m rows of `width` numbers each: n of the front, m zeros for the identity, and padding zeros.
  RowElimination(double* C, int m, int n) : C_(C), m_(m), n_(n), width_(width(m, n)) {}
  static int width(int m, int n) { return int(padded(n + m)); }  // padded to whole packs

  struct Rank {
    int pivots = 0;  // rank of the rows in F
    int passed = 0;  // rank of the other rows in B, where they are passed on; rows beyond that are dependent
  };
  // Eliminates the first F columns. `columns`: original index of each. `scratch`: 2 width numbers.
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
