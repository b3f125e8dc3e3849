#include "linear/sparse/sparse_sum.hpp"

#include <numeric>

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

using numerics::SparseSum;

// Cells of three neighbouring unknowns in a row, and what else is added to the sum.
struct Chain {
  int n = 12;
  double scale = 1;
  std::vector<std::array<int, 2>> singles = {};

  void add_to(Matrix& target) const {
    for (int first = 0; first + 2 < n; ++first) {
      const std::array<int, 3> dofs = {first + 2, first, first + 1};  // not in order
      const Mat block = scale * (first + 1) * Mat::NullaryExpr(3, 3, [](auto i, auto j) { return double(3 * i + j); });
      target.add(dofs, block, 0.5);
    }
    for (const auto& [i, j] : singles) target.add(i, j, scale);
  }
  Mat dense() const {
    Mat A = Mat::Zero(n, n);
    Matrix target = Matrix::onto(A);
    add_to(target);
    return A;
  }
  const Eigen::SparseMatrix<double>& sparse(SparseSum& sum) const {
    Matrix target = Matrix::onto(sum);
    sum.fill(n, [&] { add_to(target); });
    return sum.matrix();
  }
};

TEST(SparseSum, IsTheDenseSum) {
  SparseSum sum;
  const Chain chain{.singles = {{0, 7}, {3, 3}}};
  EXPECT_EQ(Mat(chain.sparse(sum)), chain.dense());
}

TEST(SparseSum, TakesOtherNumbersInTheSamePlaces) {
  SparseSum sum;
  Chain().sparse(sum);
  const Chain other{.scale = -3};
  EXPECT_EQ(Mat(other.sparse(sum)), other.dense());
  EXPECT_EQ(sum.patterns(), 1);
}

TEST(SparseSum, StoresNothingThatIsNotAdded) {
  SparseSum sum;
  EXPECT_EQ(Chain().sparse(sum).nonZeros(), 12 * 5 - 6);  // two neighbours on both sides
}

TEST(SparseSum, HasASymmetricPatternWithTheDiagonal) {
  SparseSum sum;
  const auto& A = Chain{.n = 2, .singles = {{0, 1}}}.sparse(sum);
  EXPECT_EQ(A.nonZeros(), 4);
  EXPECT_EQ(A.coeff(0, 1), 1);
  EXPECT_EQ(A.coeff(1, 0), 0);
}

TEST(SparseSum, WidensWhenABlockComesToOtherPlaces) {
  SparseSum sum;
  Chain().sparse(sum);
  const Chain wider{.singles = {{0, 9}, {11, 1}}};
  EXPECT_EQ(Mat(wider.sparse(sum)), wider.dense());
  EXPECT_EQ(sum.patterns(), 2);
}

TEST(SparseSum, HasThePatternOfAFreshOneWhenBlocksGoAndComeBack) {
  SparseSum sum;
  const Chain first{.singles = {{0, 9}}}, other{.singles = {{4, 3}, {0, 9}}};
  for (const Chain& chain : {first, Chain(), first, other, Chain()}) {
    SparseSum fresh;
    EXPECT_TRUE(numerics::have_one_pattern(chain.sparse(sum), chain.sparse(fresh)));
    EXPECT_EQ(Mat(chain.sparse(sum)), chain.dense());
  }
  EXPECT_EQ(sum.patterns(), 4) << "the third and the fourth have one";
}

// The same rows, and columns that differ first, last, or in their number.
TEST(SparseSum, TellsBlocksApartByTheirColumns) {
  SparseSum sum;
  const std::array<int, 2> rows = {1, 2};
  const Mat block = (Mat(2, 2) << 1, 2, 3, 4).finished();
  for (const std::array<int, 2>& columns : {std::array{3, 4}, {0, 4}, {0, 5}, {3, 4}}) {
    sum.fill(6, [&] { sum.add({rows.data(), 0, 2}, {columns.data(), 0, 2}, block, 1); });
    Mat expected = Mat::Zero(6, 6);
    expected(rows, columns) = block;
    EXPECT_EQ(Mat(sum.matrix()), expected) << columns[0] << ", " << columns[1];
  }
  EXPECT_EQ(sum.patterns(), 4);
}

TEST(SparseSum, TakesBlocksWithoutRowsOrColumns) {
  SparseSum sum;
  for (int again = 0; again < 2; ++again) {
    sum.fill(3, [&] {
      sum.add({nullptr, 0, 0}, {nullptr, 0, 2}, Mat(0, 2), 1);
      sum.add({nullptr, 0, 2}, {nullptr, 0, 0}, Mat(2, 0), 1);
    });
    EXPECT_EQ(sum.matrix().nonZeros(), 3) << "the diagonal";
    EXPECT_EQ(Mat(sum.matrix()), Mat::Zero(3, 3));
  }
  EXPECT_EQ(sum.patterns(), 1);
}

TEST(SparseSum, BeginsAfreshWithAnotherSize) {
  SparseSum sum;
  Chain().sparse(sum);
  const Chain shorter{.n = 5};
  EXPECT_EQ(Mat(shorter.sparse(sum)), shorter.dense());
  EXPECT_EQ(shorter.sparse(sum).nonZeros(), 5 * 5 - 6);
}

TEST(SparseSum, HasPlacesForWhatIsReserved) {
  SparseSum sum;
  sum.reserve({nullptr, 0, 2}, {nullptr, 8, 4});
  Chain().sparse(sum);
  const Chain later{.singles = {{1, 10}, {8, 0}}};
  EXPECT_EQ(Mat(later.sparse(sum)), later.dense());
  EXPECT_EQ(sum.patterns(), 1);
}

TEST(SparseSum, CountsFromTheOriginOfTheMatrix) {
  SparseSum sum;
  Matrix target = Matrix::onto(sum).from(2, 1);
  sum.fill(6, [&] {
    target.add(1, 1, Mat::Identity(2, 2));
    target.from(1, 0).add(0, 0, 5);
  });
  Mat expected = Mat::Zero(6, 6);
  expected(3, 2) = expected(4, 3) = 1, expected(3, 1) = 5;
  EXPECT_EQ(Mat(sum.matrix()), expected);
}

}  // namespace
}  // namespace trammel::test
