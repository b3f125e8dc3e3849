#include <trammel/matrix.hpp>

#include "linear/sparse/sparse_sum.hpp"

namespace trammel {

Matrix Matrix::onto(Mat& dense) {
  Matrix m;
  m.origin_ = dense.data();
  m.stride_ = dense.outerStride();
  return m;
}

Matrix Matrix::onto(numerics::SparseSum& sum) {
  Matrix m;
  m.sum_ = &sum;
  return m;
}

void Matrix::add_to_sum(int i, int j, double value) {
  sum_->add(row_ + i, column_ + j, value);
}

void Matrix::add(int i0, int j0, Block block, double c) {
  if (sum_) {
    const int rows = int(block.rows()), columns = int(block.cols());
    return sum_->add({nullptr, row_ + i0, rows}, {nullptr, column_ + j0, columns}, block, c);
  }
  // Plain loops: faster than Eigen's expressions for blocks with few columns.
  Eigen::Index rows = block.rows(), columns = block.cols();
  if (rows == stride_ && rows == block.outerStride()) rows *= columns, columns = 1;  // a body alone: one long column
  for (Eigen::Index j = 0; j < columns; ++j) {
    double* to = origin_ + (j0 + j) * stride_ + i0;
    const double* from = block.data() + j * block.outerStride();
    for (Eigen::Index i = 0; i < rows; ++i) to[i] += c * from[i];
  }
}

void Matrix::add(std::span<const int> rows, std::span<const int> columns, Block block, double c) {
  if (sum_)
    return sum_->add({rows.data(), row_, int(rows.size())}, {columns.data(), column_, int(columns.size())}, block, c);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    double* column = origin_ + columns[j] * stride_;
    for (std::size_t i = 0; i < rows.size(); ++i) column[rows[i]] += c * block(Eigen::Index(i), Eigen::Index(j));
  }
}

}  // namespace trammel
