#include <trammel/simd.hpp>

#include <cstddef>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace trammel::simd {

TEST(Simd, PaddedIsTheNextMultipleOfFour) {
  EXPECT_EQ(padded(0), 0);
  for (int n = 1; n <= 4; ++n) EXPECT_EQ(padded(n), 4);
  EXPECT_EQ(padded(5L), 8L);
  EXPECT_EQ(padded(std::size_t{9}), std::size_t{12});
}

// Whatever the alignment of the numbers: they start at any of them.
TEST(Simd, PacksReadAndWriteFourNumbersFromAnyOne) {
  for (std::size_t start = 0; start < 4; ++start) {
    std::vector<double> x(12);
    std::iota(x.begin(), x.end(), 1.0);
    const Pack four = pack_at(x.data() + start);
    EXPECT_EQ(total(four), 4 * double(start) + 10);
    pack_at(x.data() + start + 4) = 2 * four;
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_EQ(x[i], i < start + 4 || i >= start + 8 ? double(i + 1) : 2 * double(i - 3)) << i;
  }
}

}  // namespace trammel::simd
