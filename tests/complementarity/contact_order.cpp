// The answer belongs to the contacts, not to the order in which they are named.
#include <gtest/gtest.h>

#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

void expect_same_in_any_order(std::mt19937& random, const Problem& problem, int number) {
  const Answer first = solve(problem);
  for (int repeat = 0; repeat < 3; ++repeat) {
    const std::vector<std::size_t> order = random_order(random, problem.points.size());
    const Answer other = solve(permuted(problem, order));
    ASSERT_EQ(other.outcome, first.outcome) << problem.kind << ", " << number;
    const Vec F = permuted_back(problem, order, other.F), a = permuted_back(problem, order, other.a);
    EXPECT_LE((a - first.a).lpNorm<Eigen::Infinity>(), little(problem, F)) << problem.kind << ", " << number;
    EXPECT_LE((F - first.F).lpNorm<Eigen::Infinity>(), 1e-9 * F.lpNorm<Eigen::Infinity>())
        << problem.kind << ", " << number << "\n"
        << F.transpose() << "\n"
        << first.F.transpose();
  }
}

TEST(ContactOrder, DoesNotMatterInRandomProblems) {
  std::mt19937 random(31);
  for (int i = 0; i < 3000; ++i) expect_same_in_any_order(random, any_planar(random, 2 + i % 7), i);
}

TEST(ContactOrder, DoesNotMatterInStructures) {
  std::mt19937 random(32);
  for (int i = 0; i < 1000; ++i) expect_same_in_any_order(random, any_structure(random, 8), i);
}

}  // namespace
}  // namespace trammel::complementarity
