// Where components add their blocks, without knowing where the entries live.
//
// A component adds in its own indices; the framework has set the origin and owns the storage. An addition is a plain
// loop: no virtual call per entry.
#pragma once

#include <span>

#include <trammel/types.hpp>

namespace trammel {

class Matrix {
 public:
  using Block = const Eigen::Ref<const Mat, 0, Eigen::OuterStride<>>&;

  // entry(i0 + i, j0 + j) += c * block(i, j)
  void add(int i0, int j0, Block block, double c = 1);
  // entry(dofs[i], dofs[j]) += c * block(i, j)
  void add(std::span<const int> dofs, Block block, double c = 1) { add(dofs, dofs, block, c); }
  void add(std::span<const int> rows, std::span<const int> columns, Block block, double c = 1);
  void add(int i, int j, double value) { origin_[j * stride_ + i] += value; }

  // The same matrix, counted from entry (i, j): indices known when compiling then leave little to compute.
  Matrix from(int i, int j) const {
    Matrix shifted = *this;
    shifted.origin_ += j * stride_ + i;
    return shifted;
  }

  // --- for the framework ---
  static Matrix onto(Mat& dense);  // adds into an existing matrix

 private:
  double* origin_ = nullptr;  // what a component calls (0, 0); column-major
  Eigen::Index stride_ = 0;
};

}  // namespace trammel
