// Contacts that act on each other, of random chains.
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

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

// Contacts with and without a normal or tangents in A, with their rows anywhere. Two of three act on the one before, in
// one entry of A, which need not be symmetric where friction follows from normal forces.
struct Scattered {
  std::vector<ContactPoint> points;
  Mat A;
  std::vector<std::size_t> chain;  // of each contact
};

Scattered scattered(std::mt19937& random) {
  Scattered s;
  const int n = 1 + int(random() % 8);
  int rows = 0;
  std::vector<int> first;  // row of each contact
  for (int k = 0; k < n; ++k) {
    const bool normal = random() % 4, tangents = !normal || random() % 2;
    ContactPoint& p = s.points.emplace_back();
    first.push_back(rows);
    if (random() % 2 && normal) p.normal = rows++;
    if (tangents) p.tangent = rows, p.tangents = 1 + int(random() % 2), rows += p.tangents;
    if (normal && p.normal < 0) p.normal = rows++;
  }
  first.push_back(rows);
  s.A = Mat::Identity(rows, rows);
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    s.chain.push_back(k > 0 && random() % 3 ? s.chain.back() : k);
    if (s.chain[k] == k) continue;
    const auto any_row = [&](std::size_t of) { return first[of] + int(random() % 100) % (first[of + 1] - first[of]); };
    const int i = any_row(k), j = any_row(k - 1);
    (random() % 2 ? s.A(i, j) : s.A(j, i)) = 0.1;
  }
  std::shuffle(s.points.begin(), s.points.end(), random);
  return s;
}

TEST(Islands, AreProblemsOfTheirOwnWithAllRowsOfTheirContacts) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Scattered s = scattered(random);
    const std::vector<std::size_t> number = island_of_each(s.points, s.A);
    const std::vector<Island> all = islands(s.points, s.A);
    EXPECT_EQ(all.size(), std::set<std::size_t>(s.chain.begin(), s.chain.end()).size());
    std::vector<Eigen::Index> rows;
    std::size_t members = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Island& island = all[k];
      ASSERT_EQ(island.points.size(), island.members.size());
      for (std::size_t m = 0; m < island.members.size(); ++m, ++members) {
        const ContactPoint &own = island.points[m], &named = s.points[island.members[m]];
        EXPECT_EQ(number[island.members[m]], k);
        ASSERT_EQ(own.normal < 0, named.normal < 0);
        ASSERT_EQ(own.tangent < 0, named.tangent < 0);
        if (own.normal >= 0) {
          EXPECT_EQ(island.rows.at(std::size_t(own.normal)), named.normal);
        }
        for (int t = 0; t < own.tangents && own.tangent >= 0; ++t)
          EXPECT_EQ(island.rows.at(std::size_t(own.tangent + t)), named.tangent + t);
      }
      rows.insert(rows.end(), island.rows.begin(), island.rows.end());
    }
    EXPECT_EQ(members, s.points.size());
    std::sort(rows.begin(), rows.end());
    std::vector<Eigen::Index> every(std::size_t(s.A.rows()));
    std::iota(every.begin(), every.end(), Eigen::Index(0));
    EXPECT_EQ(rows, every);
  }
}

}  // namespace
}  // namespace trammel::test
