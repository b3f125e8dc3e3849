#include "study/reduction.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace trammel::study {
namespace {

// x = cos t over a whole number of turns.
Series cosine() {
  constexpr int n = 2000;
  Series s{{"x"}, {}, {}};
  for (int i = 0; i <= n; ++i) s.t.push_back(4 * M_PI * i / n), s.values.push_back(std::cos(s.t.back()));
  return s;
}

Reduction of(Reduction::As as) {
  Reduction one;
  one.observe = "x", one.as = as;
  return one;
}

TEST(Reduction, OfACosineIsKnown) {
  const Series s = cosine();
  EXPECT_EQ(of(Reduction::As::initial).of(s), 1);
  EXPECT_NEAR(of(Reduction::As::min).of(s), -1, 1e-12);  // a record falls on it, to round-off
  // The trapezoidal rule is exact for whole periods up to round-off.
  EXPECT_NEAR(of(Reduction::As::rms).of(s), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(of(Reduction::As::mean).of(s), 0, 1e-12);
}

TEST(Reduction, FindsTheFirstCrossingInItsDirection) {
  const Series s = cosine();
  Reduction crossing = of(Reduction::As::first_crossing);
  const double h = 4 * M_PI / 2000, linear = h * h;  // of the line between records
  EXPECT_NEAR(crossing.of(s), M_PI / 2, linear);
  crossing.direction = Reduction::Direction::up;
  EXPECT_NEAR(crossing.of(s), 3 * M_PI / 2, linear);
  crossing.level = 2;
  EXPECT_TRUE(std::isnan(crossing.of(s)));
}

TEST(Reduction, OfTheDifferenceToAReferenceIsLinearBetweenItsRows) {
  Reduction rms = of(Reduction::As::rms);
  rms.reference = {0, {0, 1}, {0, 2}};
  EXPECT_DOUBLE_EQ(rms.of({{"x"}, {0, 0.5, 1}, {3, 4, 5}}), 3);
}

TEST(Reduction, OfAColumnThatIsNotThereIsNoNumber) {
  Reduction one = of(Reduction::As::max);
  one.observe = "y";
  EXPECT_TRUE(std::isnan(one.of(cosine())));
}

}  // namespace
}  // namespace trammel::study
