// Blocks of one width on each other, each corner described twice: on the face below it, and the corner below it under
// its own face. Corners that have slid apart by less than they are large leave rows that nearly depend on each other.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planar_bodies.hpp"
#include "support/between.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::between;

// By how much corners are apart, or blocks turned against each other.
double little_off(std::mt19937& random) {
  return std::pow(10, between(random, -11, -5)) * (between(random, 0, 1) < 0.5 ? -1 : 1);
}

// Some of the blocks move, the others are at rest: rates before an impact, in which the forces are impulses.
Problem struck_tower(std::mt19937& random) {
  PlanarBodies bodies;
  const int blocks = 2 + int(between(random, 0, 5));
  const double mu = between(random, 0.3, 1.5), w = between(random, 0.1, 0.4);
  int below = PlanarBodies::ground;
  double y = 0, turned_below = 0;
  for (int i = 0; i < blocks; ++i) {
    const double h = between(random, 0.8, 1.5) * w, m = between(random, 0.5, 2), turned = little_off(random);
    const bool moves = between(random, 0, 1) < 0.4;
    const Vector3d rates = moves ? Vector3d(between(random, -1, 1), between(random, -1, 0), between(random, -2, 2) / w)
                                 : Vector3d(0, 0, 0);
    const int block = bodies.add({0, y + h / 2}, m, m * (w * w + h * h) / 12, rates);
    for (const double side : {-0.5, 0.5}) {
      const double apart = little_off(random) * w;
      bodies.touch(below, block, {side * w, y}, {-std::sin(turned_below), std::cos(turned_below)}, mu);
      if (below != PlanarBodies::ground)
        bodies.touch(below, block, {side * w + apart, y}, {-std::sin(turned), std::cos(turned)}, mu);
    }
    below = block, y += h, turned_below = turned;
  }
  return bodies.problem("tower of " + std::to_string(blocks));
}

TEST(StruckTowers, WhoseCornersNearlyMeetHaveImpulses) {
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    const Problem problem = struck_tower(random);
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << problem.kind << ", " << i << ": " << answer.violation;
  }
}

}  // namespace
}  // namespace trammel::complementarity
