// Of forces that are not unique the documented ones are chosen: of least norm.
#include <gtest/gtest.h>

#include "least_norm.hpp"
#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

// Solved for with equations of condition up to 1e6: a few digits are lost of 1e-14.
constexpr double round_off = 1e-8;

int least_norms(const Problem& problem, int number) {
  const Answer answer = solve(problem);
  const double nothing = little(problem, answer.F);
  if (answer.outcome != LcpOutcome::solved || slides(problem, answer.a, nothing)) return 0;
  EXPECT_LE(distance_from_least_norm(problem, answer.F, answer.a, nothing), round_off)
      << problem.kind << ", " << number << ": " << answer.F.transpose();
  return 1;
}

TEST(ForceChoice, IsTheLeastNormWithoutFriction) {
  std::mt19937 random(41);
  for (int i = 0; i < 300; ++i)
    least_norms(random_normals(random, 1 + int(random() % 20), 1 + int(random() % 8), 0), i);
}

TEST(ForceChoice, IsTheLeastNormInRandomProblems) {
  std::mt19937 random(42);
  int looked_at = 0;
  for (int i = 0; i < 3000; ++i) looked_at += least_norms(any_planar(random, 2 + i % 7), i);
  EXPECT_GT(looked_at, 300);
}

TEST(ForceChoice, IsTheLeastNormInStructures) {
  std::mt19937 random(43);
  int looked_at = 0;
  for (int i = 0; i < 2000; ++i) looked_at += least_norms(any_structure(random, 8), i);
  EXPECT_GT(looked_at, 300);
}

}  // namespace
}  // namespace trammel::complementarity
