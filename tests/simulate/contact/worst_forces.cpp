// Which of the forces that contacts cannot exert are told in the end.
#include "simulate/contact/worst_forces.hpp"

#include <gtest/gtest.h>

#include "linear/dense/eps.hpp"

namespace trammel::test {
namespace {

using simulate::Violation;
using simulate::WorstForces;

TEST(WorstForces, AreTheLargestOfTheirKind) {
  WorstForces forces;
  forces.take_force(0, 10);
  forces.raise(Violation::pull, 0, {3, 0.1, 1});
  forces.raise(Violation::pull, 0, {4, 0.2, 2});
  forces.raise(Violation::pull, 0, {5, 0.3, 1.5});
  const auto worst = forces.worst(Violation::pull);
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->contact, 4);
  EXPECT_EQ(worst->t, 0.2);
  EXPECT_FALSE(forces.worst(Violation::beyond_cone));
}

// At first a contact pulls with all that acts on it, which turns out to be round-off of what acts on it later. Between,
// another one pulls with a part of what acts on it.
TEST(WorstForces, AreNotHiddenByOnesThatTurnOutToBeRoundOff) {
  WorstForces forces;
  forces.take_force(0, 1e-12);
  forces.raise(Violation::pull, 0, {0, 0.1, 1e-12});
  forces.take_force(0, 100);
  forces.raise(Violation::pull, 0, {1, 0.2, 1});
  forces.take_force(0, 1e6);
  const auto worst = forces.worst(Violation::pull);
  ASSERT_TRUE(worst);
  EXPECT_EQ(worst->contact, 1);
}

TEST(WorstForces, DoNotCountAsRoundOffOfAnyForceOfTheirIsland) {
  for (const double largest : {0.9, 1.1}) {
    WorstForces forces;
    forces.take_force(7, largest / eps);
    forces.raise(Violation::along_slip, 7, {0, 0, 1});
    EXPECT_EQ(forces.worst(Violation::along_slip).has_value(), largest < 1);
  }
}

TEST(WorstForces, AreThoseOfTheIslandInWhichTheyAreLargestBesideItsForces) {
  WorstForces forces;
  forces.take_force(0, 1e20), forces.take_force(1, 10);
  forces.raise(Violation::overloaded, 0, {0, 0.1, 1000});
  forces.raise(Violation::overloaded, 1, {1, 0.2, 1});
  EXPECT_EQ(forces.worst(Violation::overloaded)->contact, 1);
}

}  // namespace
}  // namespace trammel::test
