// What components add is the same in a dense and in a sparse matrix.
#include <trammel/matrix.hpp>

#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "linear/sparse/sparse_sum.hpp"

namespace trammel {
namespace {

using Additions = std::function<void(Matrix&)>;

Mat dense(int n, const Additions& additions) {
  Mat sum = Mat::Ones(n, n);
  Matrix matrix = Matrix::onto(sum);
  additions(matrix);
  return sum;
}
Mat sparse(int n, const Additions& additions) {
  numerics::SparseSum sum;
  sum.fill(n, [&] {
    Matrix matrix = Matrix::onto(sum);
    additions(matrix);
  });
  return Mat(sum.matrix()) + Mat::Ones(n, n);
}
void expect_both(const Mat& expected, const Additions& additions) {
  const int n = int(expected.rows());
  EXPECT_EQ(dense(n, additions), expected);
  EXPECT_EQ(sparse(n, additions), expected);
}

const Mat block{{1, 2}, {3, 4}};

TEST(Matrix, AddsABlockTimesAFactorAtTheGivenIndices) {
  Mat expected = Mat::Ones(4, 4);
  expected.block(1, 2, 2, 2) += 3 * block;
  expect_both(expected, [](Matrix& m) { m.add(1, 2, block, 3); });
}

TEST(Matrix, AddsOneBlockOfItsWholeSize) {
  const Mat whole = Vec::LinSpaced(9, 1, 9).reshaped(3, 3);
  expect_both(Mat::Ones(3, 3) - 2 * whole, [&](Matrix& m) { m.add(0, 0, whole, -2); });
}

// A block within a larger matrix: its columns are farther apart than they are long.
TEST(Matrix, AddsAPartOfALargerMatrix) {
  const Mat larger = Vec::LinSpaced(16, 1, 16).reshaped(4, 4);
  const Mat part = larger.topRows(3).leftCols(3);
  expect_both(Mat::Ones(3, 3) + part, [&](Matrix& m) { m.add(0, 0, larger.topLeftCorner(3, 3)); });
}

TEST(Matrix, AddsABlockToScatteredPlaces) {
  const std::array<int, 2> rows = {3, 0}, columns = {1, 2};
  Mat expected = Mat::Ones(4, 4);
  expected(3, 1) += 2, expected(3, 2) += 4, expected(0, 1) += 6, expected(0, 2) += 8;
  expect_both(expected, [&](Matrix& m) { m.add(rows, columns, block, 2); });
}

TEST(Matrix, CountsFromTheEntryOfAPart) {
  const std::array<int, 2> dofs = {0, 1};
  Mat expected = Mat::Ones(5, 5);
  expected(2, 3) += 7;
  expected.block(2, 3, 2, 2) += block;
  expected.block(1, 2, 2, 2) += block;
  expect_both(expected, [&](Matrix& m) {
    Matrix part = m.from(1, 2);
    part.add(1, 1, 7.0);
    part.add(1, 1, block);
    part.add(dofs, block);
  });
}

}  // namespace
}  // namespace trammel
