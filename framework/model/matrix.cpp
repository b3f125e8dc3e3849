#include <trammel/matrix.hpp>

namespace trammel {

Matrix Matrix::onto(Mat& dense) {
  Matrix m;
  m.data_ = dense.data();
  m.stride_ = dense.outerStride();
  return m;
}

void Matrix::add(int i0, int j0, Block block, double c) {
  using Place = Eigen::Map<Mat, 0, Eigen::OuterStride<>>;
  Place(data_ + (column_ + j0) * stride_ + row_ + i0, block.rows(), block.cols(), Eigen::OuterStride<>(stride_))
      .noalias() += c * block;
}

void Matrix::add(std::span<const int> rows, std::span<const int> columns, Block block, double c) {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    double* column = data_ + (column_ + columns[j]) * stride_ + row_;
    for (std::size_t i = 0; i < rows.size(); ++i) column[rows[i]] += c * block(Eigen::Index(i), Eigen::Index(j));
  }
}

}  // namespace trammel
