// The rows of a front, eliminated by Householder reflections with column pivoting:
//
//     Q^T [C_F C_B] P = [R  *   *]      columns of F first, the longest first; then those of B, in the rest of the rows, where they
//                       [0  0  C'']     are: not permuted
//
// A column counts while it is longer than the tolerance; rows have length one. C is kept by rows: a reflection then combines rows
// as long as the front is wide, which the processor does by several numbers at once.
#pragma once

#include <trammel/types.hpp>

namespace trammel::numerics {

class RowElimination {
 public:
  // 1 - tau v v^T on the rows from `begin` on
  struct Reflection {
    int begin = 0;
    double tau = 0;
  };
  // Of the reflections the v go to `vectors` one after the other, m apart.
  RowElimination(double* C, int m, int n, Reflection* reflections, double* vectors)
      : C_(C), m_(m), n_(n), reflections_(reflections), vectors_(vectors) {}

  struct Rank {
    int told = 0, passed = 0;  // rows that tell of F, and of the others those that tell of B; the rest tell nothing
  };
  // The first F columns; `columns`: where each came from. `scratch`: 2 n numbers.
  Rank run(int F, double tolerance, int* columns, double* scratch);

  // The first `count` reflections, in their order or backwards, to w (m).
  void apply(int count, double* w) const;
  void apply_back(int count, double* w) const;

 private:
  double* row(int i) const { return C_ + i * n_; }
  int eliminate(int first, int last, int begin, double tolerance, int* columns, double* scratch);
  void bring_forward(int j, int first, int* columns);
  void reflect(int j, int begin, double* scratch);

  double* C_;
  int m_, n_, F_ = 0, count_ = 0;
  Reflection* reflections_;
  double* vectors_;
};

}  // namespace trammel::numerics
