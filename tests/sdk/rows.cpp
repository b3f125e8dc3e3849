// Rows, quadrature and lists in archives: what is there after they were made.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <trammel/body.hpp>
#include <trammel/marker.hpp>
#include <trammel/quadrature.hpp>
#include <trammel/testing/archive.hpp>

namespace trammel {
namespace {

TEST(Rows, AreZeroWhateverWasThere) {
  Rows rows;
  rows.resize(3, Space::spatial, 4);
  rows.g.setOnes(), rows.g_t.setOnes(), rows.gamma.setOnes();
  for (int k = 0; k < 4; ++k) rows.H(k).setOnes();
  rows.resize(2, Space::planar, 2);
  for (const Vec6& x : {rows.g, rows.g_t, rows.gamma}) {
    ASSERT_EQ(x.size(), 2);
    EXPECT_TRUE(x.isZero(0));
  }
  for (int k = 0; k < 2; ++k) {
    ASSERT_EQ(rows.H(k).rows(), 2);
    ASSERT_EQ(rows.H(k).cols(), 3);
    EXPECT_TRUE(rows.H(k).isZero(0));
  }
  for (int k = 2; k < 4; ++k) EXPECT_EQ(rows.H(k).rows(), 0) << "of a marker that does not exist";
}

TEST(BodyRows, AreZeroWhateverWasThere) {
  BodyRows rows;
  for (int again = 0; again < 2; ++again) {
    rows.resize(2, 5);
    for (const Vec* x : {&rows.g, &rows.g_t, &rows.gamma}) {
      ASSERT_EQ(x->size(), 2);
      EXPECT_TRUE(x->isZero(0));
    }
    ASSERT_EQ(rows.G.rows(), 2);
    ASSERT_EQ(rows.G.cols(), 5);
    EXPECT_TRUE(rows.G.isZero(0));
    rows.g.setOnes(), rows.g_t.setOnes(), rows.gamma.setOnes(), rows.G.setOnes();
  }
}

// n points integrate polynomials of degree 2n - 1.
TEST(Quadrature, IsExactForPolynomialsOfDegreeTwoNMinusOne) {
  const double a = -0.5, b = 2;
  for (int n = 1; n <= 6; ++n) {
    const Quadrature rule = gauss_legendre(n, a, b);
    EXPECT_TRUE(std::is_sorted(rule.x.begin(), rule.x.end()));
    for (int p = 0; p <= 2 * n; ++p) {
      const double exact = (std::pow(b, p + 1) - std::pow(a, p + 1)) / (p + 1);
      const double sum = rule.weight.dot(rule.x.array().pow(p).matrix());
      if (p < 2 * n)
        EXPECT_NEAR(sum, exact, 1e-13 * std::pow(2, p)) << n << " points, degree " << p;
      else
        EXPECT_GT(std::abs(sum - exact), 1e-6) << n << " points, degree " << p;
    }
  }
}

using List = std::vector<Vec>;

List read(const List& written, List into) {
  MemoryArchive memory;
  List list = written;
  memory("list", list);
  memory.reading = true;
  memory("list", into);
  return into;
}

TEST(Archive, ReadsAListOfAnyLengthOverAnother) {
  const List one = {Vec::Constant(1, 1)}, three = {Vec::Constant(1, 1), Vec::Constant(2, 2), Vec::Constant(3, 3)};
  EXPECT_EQ(read(three, {}), three);
  EXPECT_EQ(read(three, one), three);
  EXPECT_EQ(read(one, three), one);
  EXPECT_TRUE(read({}, three).empty());
}

TEST(Archive, RefusesAListOfNegativeLength) {
  MemoryArchive memory;
  int count = -1;
  memory("list.count", count);
  memory.reading = true;
  List list;
  EXPECT_THROW(memory("list", list), std::length_error);
}

}  // namespace
}  // namespace trammel
