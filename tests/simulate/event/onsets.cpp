// When a gap that closes only touches.
#include "simulate/event/onsets.hpp"

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

using simulate::grazes;

// f + rate t + acceleration t^2/2 has its least value f - rate^2/(2 acceleration).
TEST(AGapThatCloses, OnlyTouchesIfItsParabolaStaysAboveMinusItsNoise) {
  EXPECT_TRUE(grazes({0, -2e-6}, 4, 0.6e-12));
  EXPECT_FALSE(grazes({0, -2e-6}, 4, 0.4e-12));
  EXPECT_TRUE(grazes({0.2e-12, -2e-6}, 4, 0.4e-12));
  EXPECT_FALSE(grazes({-0.2e-12, -2e-6}, 4, 0.6e-12));
}

TEST(AGapThatCloses, StrikesIfNothingOpensIt) {
  EXPECT_FALSE(grazes({0, -1e-9}, 0, 1e-12));
  EXPECT_FALSE(grazes({0, -1e-9}, -10, 1e-12));
}

TEST(AGapThatOpens, DoesNotTouch) {
  EXPECT_FALSE(grazes({0, 1e-9}, 10, 1e-12));
}

}  // namespace
}  // namespace trammel::test
