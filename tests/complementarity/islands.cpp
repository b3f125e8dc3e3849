// Contacts that act on each other, of random chains.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "complementarity/islands.hpp"

namespace trammel::test {
namespace {

using namespace complementarity;

TEST(Islands, AreTheChainsOfContactsWhateverTheirOrder) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const int n = 1 + int(random() % 12);
    std::vector<int> chain(static_cast<std::size_t>(n));  // of each contact
    for (int& c : chain) c = int(random() % 4);
    std::vector<ContactPoint> points;
    for (int k = 0; k < n; ++k) points.push_back({.normal = 2 * k, .tangent = 2 * k + 1, .tangents = 1});
    Mat A = Mat::Identity(2 * n, 2 * n);
    for (int k = 0, last[4] = {-1, -1, -1, -1}; k < n; ++k) {
      int& before = last[chain[std::size_t(k)]];
      if (before >= 0) A(2 * k, 2 * before + 1) = A(2 * before + 1, 2 * k) = 0.1;
      before = k;
    }
    const std::vector<std::size_t> number = island_of_each(points, A);
    for (std::size_t k = 0; k < chain.size(); ++k) {
      EXPECT_LT(number[k], chain.size());
      for (std::size_t j = 0; j < k; ++j) EXPECT_EQ(number[j] == number[k], chain[j] == chain[k]) << i;
    }
    EXPECT_EQ(islands(points, A).size(), *std::max_element(number.begin(), number.end()) + 1);
  }
}

}  // namespace
}  // namespace trammel::test
