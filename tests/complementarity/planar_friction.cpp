// Friction in the plane, against the enumeration of all modes: forces are found wherever there are some, and only
// there.
#include <gtest/gtest.h>

#include <map>

#include "every_mode.hpp"
#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

void expect_what_enumeration_says(const Problem& problem, int number) {
  const Answer answer = solve(problem);
  if (answer.outcome == LcpOutcome::solved) {
    EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F)) << problem.kind << ", " << number;
    return;
  }
  EXPECT_EQ(answer.outcome, LcpOutcome::no_solution) << "gave up on " << problem.kind << ", " << number;
  Vec F;
  EXPECT_FALSE(exists_in_some_mode(problem, F))
      << "missed one of " << problem.kind << ", " << number << ": " << F.transpose();
}

// 1 to 5 contacts mostly, each 20th of 8: all modes of those without a solution are looked at.
TEST(PlanarFriction, IsFoundWhereverItExistsInRandomProblems) {
  std::mt19937 random(27);
  for (int i = 0; i < 10000; ++i) expect_what_enumeration_says(any_planar(random, i % 20 == 0 ? 8 : 1 + i % 5), i);
}

TEST(PlanarFriction, IsFoundWhereverItExistsInStructures) {
  std::mt19937 random(28);
  for (int i = 0; i < 2000; ++i) expect_what_enumeration_says(any_structure(random, 8), i);
}

// The judge itself: it finds what the solver found.
TEST(PlanarFriction, IsFoundByEnumerationToo) {
  std::mt19937 random(29);
  for (int i = 0; i < 1000; ++i) {
    const Problem problem = i % 2 ? any_structure(random, 5) : any_planar(random, 1 + i % 5);
    Vec F;
    const bool solved = solve(problem).outcome == LcpOutcome::solved;
    EXPECT_TRUE(!solved || exists_in_some_mode(problem, F)) << problem.kind << ", " << i;
  }
}

}  // namespace
}  // namespace trammel::complementarity
