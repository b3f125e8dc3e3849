#include "linear/dense/block_signs.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <trammel/decompositions.hpp>
#include <trammel/testing/archive.hpp>

#include "linear/dense/lu.hpp"

namespace trammel::test {
namespace {

using numerics::BlockSigns;

// Well conditioned, with its largest entries off the diagonal: rows must be exchanged.
Mat with_exchanged_rows(int n) {
  Mat A = Mat::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) { return 1.0 / double(i + 2 * j + 3); });
  for (Eigen::Index i = 0; i < n; ++i) A((i + 1) % n, i) += 4;
  return A;
}

int sign_of_determinant(const Mat& A) {
  return Eigen::FullPivLU<Mat>(A).determinant() > 0 ? 1 : -1;
}

BlockSigns signs_of(const Mat& A) {
  numerics::Lu lu;
  lu.compute(A);
  BlockSigns signs;
  signs.find(A, lu, 1e-10);
  return signs;
}

class BlockSignsOf : public testing::TestWithParam<int> {};

TEST_P(BlockSignsOf, OneBlockHaveTheSignOfItsDeterminant) {
  const int n = GetParam();
  Mat A = with_exchanged_rows(n);
  const int sign = sign_of_determinant(A);
  EXPECT_EQ(signs_of(A).of_row(0), sign);
  A.col(n / 2) *= -1;
  EXPECT_EQ(signs_of(A).of_row(n - 1), -sign);
  if (n == 1) return;
  A.row(0).swap(A.row(n - 1));
  EXPECT_EQ(signs_of(A).of_row(0), sign);
}

// Rows of the three blocks alternate.
struct Mixed {
  int n;
  Mat A;

  explicit Mixed(int size) : n(size), A(Mat::Zero(3 * n, 3 * n)) {
    for (int k = 0; k < 3; ++k) block(k) = with_exchanged_rows(n);
  }
  std::vector<int> rows(int k) const {
    std::vector<int> all;
    for (int i = 0; i < n; ++i) all.push_back(3 * i + k);
    return all;
  }
  Eigen::IndexedView<Mat, std::vector<int>, std::vector<int>> block(int k) { return A(rows(k), rows(k)); }
};

TEST_P(BlockSignsOf, SeveralBlocksAreThoseOfEach) {
  Mixed mixed(GetParam());
  const int sign = sign_of_determinant(with_exchanged_rows(mixed.n));
  mixed.A.col(1) *= -1;
  const BlockSigns signs = signs_of(mixed.A);
  for (int i = 0; i < mixed.A.rows(); ++i) EXPECT_EQ(signs.of_row(i), i % 3 == 1 ? -sign : sign);
}

TEST_P(BlockSignsOf, TwoBlocksThatChangeDoNotCancel) {
  Mixed mixed(GetParam());
  const BlockSigns before = signs_of(mixed.A);
  EXPECT_FALSE(any_opposite(before, before));
  mixed.A.col(0) *= -1, mixed.A.col(2) *= -1;
  const BlockSigns after = signs_of(mixed.A);
  EXPECT_TRUE(any_opposite(before, after) && any_opposite(after, before));
  mixed.A.row(0) *= -1, mixed.A.row(2) *= -1;
  EXPECT_FALSE(any_opposite(before, signs_of(mixed.A)));
}

TEST_P(BlockSignsOf, ASingularBlockAreUnknownAndThoseOfOthersAreNot) {
  Mixed mixed(GetParam());
  const BlockSigns before = signs_of(mixed.A);
  mixed.A.col(0).setZero();
  EXPECT_FALSE(any_opposite(before, signs_of(mixed.A)));
  mixed.A.col(1) *= -1;
  const BlockSigns after = signs_of(mixed.A);
  EXPECT_EQ(after.of_row(0), 0);
  EXPECT_TRUE(any_opposite(before, after));
}

// An entry that is 0 at one point only does not divide a block.
TEST_P(BlockSignsOf, BlocksThatActOnEachOtherAtOneOfTwoPointsAreCompared) {
  Mixed mixed(GetParam());
  const BlockSigns before = signs_of(mixed.A);
  mixed.A.col(0) *= -1, mixed.A.col(1) *= -1;
  mixed.A(0, 1) = 1e-3;
  const BlockSigns joined = signs_of(mixed.A);
  EXPECT_FALSE(any_opposite(before, joined));
  EXPECT_FALSE(any_opposite(joined, before));
  mixed.A.col(2) *= -1;
  EXPECT_TRUE(any_opposite(before, signs_of(mixed.A)));
}

TEST_P(BlockSignsOf, RowsThatAreFlippedAreOneBlock) {
  Mixed mixed(GetParam());
  const BlockSigns before = signs_of(mixed.A);
  BlockSigns after = before;
  after.flip({0, 1});
  EXPECT_TRUE(any_opposite(before, after));
  after.flip({1});
  EXPECT_FALSE(any_opposite(before, after));
}

TEST(BlockSigns, ThatAreNotKnownAreNotOpposite) {
  const BlockSigns one = signs_of(Mat::Constant(1, 1, -1)), none;
  EXPECT_FALSE(any_opposite(one, none));
  EXPECT_FALSE(any_opposite(none, one));
}

TEST_P(BlockSignsOf, BlocksAreReadBackFromAnArchive) {
  Mixed mixed(GetParam());
  BlockSigns written = signs_of(mixed.A), read;
  mixed.A.col(1) *= -1;
  const BlockSigns other = signs_of(mixed.A);
  MemoryArchive archive;
  written.archive(archive, "signs");
  archive.reading = true;
  read.archive(archive, "signs");
  for (int i = 0; i < 3 * mixed.n; ++i) EXPECT_EQ(read.of_row(i), written.of_row(i)) << i;
  EXPECT_FALSE(any_opposite(read, written));
  EXPECT_TRUE(any_opposite(read, other));
}

TEST(BlockSigns, RefuseArchivesWhoseRowsBelongToNoBlock) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec& flat : {Vec{{1, 1}}, Vec{{-1, 1}}, Vec{{nan, 1}}, Vec{{0, 2}}, Vec{{0, nan}}, Vec{{0, 2, 1, 1}}}) {
    MemoryArchive archive;
    archive.vectors["signs"] = flat;
    archive.reading = true;
    BlockSigns signs;
    EXPECT_THROW(signs.archive(archive, "signs"), std::out_of_range) << flat.transpose();
  }
}

// Blocks within padded columns of Lu, and beyond the crossover to Eigen's.
INSTANTIATE_TEST_SUITE_P(Sizes, BlockSignsOf, testing::Values(1, 2, 7, 16, 17, 48, 49, 150));

}  // namespace
}  // namespace trammel::test
