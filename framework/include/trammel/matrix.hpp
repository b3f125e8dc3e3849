// A matrix to which components add their blocks, dense or sparse.
//
// A component uses its own indices; the framework has set the origin and owns the storage. An addition is a plain loop
// without a virtual call per entry. A body with many coordinates must add its blocks in the same order every time, and
// only entries that may differ from 0: then the positions of sparse entries are found once, and zero blocks cost
// nothing.
#pragma once

#include <span>

#include <trammel/types.hpp>

namespace trammel {

namespace numerics {
class SparseSum;
}

class Matrix {
 public:
  using Block = const Eigen::Ref<const Mat, 0, Eigen::OuterStride<>>&;

  // entry(i0 + i, j0 + j) += c * block(i, j)
  void add(int i0, int j0, Block block, double c = 1);
  // entry(dofs[i], dofs[j]) += c * block(i, j)
  void add(std::span<const int> dofs, Block block, double c = 1) { add(dofs, dofs, block, c); }
  void add(std::span<const int> rows, std::span<const int> columns, Block block, double c = 1);
  void add(int i, int j, double value) {
    if (sum_) return add_to_sum(i, j, value);
    origin_[j * stride_ + i] += value;
  }

  // The same matrix with indices relative to entry (i, j). Indices that are compile-time constants then cost little.
  Matrix from(int i, int j) const {
    Matrix shifted = *this;
    if (!sum_) shifted.origin_ += j * stride_ + i;
    shifted.row_ += i, shifted.column_ += j;
    return shifted;
  }

  // --- for the framework ---
  static Matrix onto(Mat& dense);  // adds into an existing matrix
  static Matrix onto(numerics::SparseSum& sum);

 private:
  void add_to_sum(int i, int j, double value);

  double* origin_ = nullptr;  // entry (0, 0) in the component's indices; column-major
  Eigen::Index stride_ = 0;
  numerics::SparseSum* sum_ = nullptr;  // used instead if not null, with origin (row_, column_)
  int row_ = 0, column_ = 0;
};

}  // namespace trammel
