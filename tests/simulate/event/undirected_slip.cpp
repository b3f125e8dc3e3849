#include "simulate/event/undirected_slip.hpp"

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

// An acceleration of 1 m/s^2 passes 1e-3 m/s in 1e-3 s, ten times of which is 1e-2 s.
TEST(UndirectedSlip, StallsAfterManyTimesTheTimeThatItsAccelerationNeeds) {
  simulate::UndirectedSlip slip;
  for (int i = 0; i < 9; ++i) {
    EXPECT_FALSE(slip.would_stall(1e-3, 1, 1e-3)) << i;
    slip.lasts(1e-3, 1);
  }
  EXPECT_TRUE(slip.would_stall(1.1e-3, 1, 1e-3));
}

TEST(UndirectedSlip, CountsItsLargestAcceleration) {
  simulate::UndirectedSlip slip;
  slip.lasts(5e-3, 2);
  EXPECT_TRUE(slip.would_stall(1e-3, 0.1, 1e-3));
}

TEST(UndirectedSlip, BeginsAnewAfterItHadADirection) {
  simulate::UndirectedSlip slip;
  slip.lasts(1, 1);
  slip.ends();
  EXPECT_FALSE(slip.would_stall(1e-3, 1, 1e-3));
}

}  // namespace
}  // namespace trammel::test
