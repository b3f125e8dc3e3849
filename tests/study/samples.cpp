#include "study/samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trammel::study {
namespace {

using testing::ElementsAre;

TEST(Samples, OfAGridRunTheLastIndexFastest) {
  EXPECT_THAT(grid({2, 3}), ElementsAre(ElementsAre(0, 0), ElementsAre(0, 1), ElementsAre(0, 2), ElementsAre(1, 0),
                                        ElementsAre(1, 1), ElementsAre(1, 2)));
}

TEST(Samples, OfALogarithmicRangeHaveAConstantRatioAndItsEnds) {
  const Range range{0.1, 10, true};
  EXPECT_EQ(range.at(0), 0.1);
  EXPECT_NEAR(range.at(0.5), 1, 1e-15);  // one rounding of the power
  EXPECT_EQ(range.at(1), 10);
}

// The first 2^m points have one in each interval of length 2^-m, in each dimension: Sobol's property.
TEST(Samples, OfSobolFillEachDimensionEvenly) {
  constexpr std::size_t n = 64;
  const auto points = sobol_points(n - 1, 3, std::nullopt);  // the first one, a corner, is left out
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<int> in(n, 0);
    in[0] = 1;
    for (const auto& point : points) ++in[std::size_t(point[k] * n)];
    EXPECT_THAT(in, testing::Each(1)) << "dimension " << k;
  }
}

TEST(Samples, OfOneSeedAreTheSame) {
  EXPECT_EQ(random_points(5, 2, 7), random_points(5, 2, 7));
  EXPECT_NE(random_points(5, 2, 7), random_points(5, 2, 8));
  EXPECT_NE(sobol_points(5, 2, 7), sobol_points(5, 2, 8));
}

}  // namespace
}  // namespace trammel::study
