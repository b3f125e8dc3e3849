// Where components add their blocks, without knowing where the entries live.
//
// A component adds in its own indices; the framework has set the origin. Into dense storage an addition is a plain loop.
// Into sparse storage the first assembly records which slots the sequence of calls touches, and later ones replay it; a
// different order of calls only costs a new recording.
#pragma once

#include <span>
#include <vector>

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
  void add(int i, int j, double value) { add_entry(row_ + i, column_ + j, value); }

  // --- for the framework ---
  struct Pattern;  // the recorded sequence of a sparse matrix

  static Matrix onto(Mat& dense);            // adds into an existing dense matrix
  static Matrix onto(Pattern& sparse);       // records into, or replays onto, a sparse pattern
  void origin(int row, int column) { row_ = row, column_ = column; }  // what a component calls (0, 0)

 private:
  void add_entry(int i, int j, double value);

  double* data_ = nullptr;  // column-major
  Eigen::Index stride_ = 0;
  Pattern* pattern_ = nullptr;
  int row_ = 0, column_ = 0;
};

}  // namespace trammel
