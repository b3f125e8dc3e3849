// Numbers at their limits, units, and many contacts: answers are verified where no enumeration can judge.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

void expect_solved(const Problem& problem) {
  const Answer answer = solve(problem);
  ASSERT_EQ(answer.outcome, LcpOutcome::solved) << problem.kind << ", violation " << answer.violation;
  EXPECT_LE(offence(problem, answer.F, answer.a), little(problem, answer.F)) << problem.kind;
}

TEST(Limits, NothingComesOfNothing) {
  std::mt19937 random(51);
  for (int i = 0; i < 200; ++i) {
    Problem problem = i % 2 ? any_structure(random, 8) : any_planar(random, 1 + i % 8);
    problem.b.setZero();
    for (ContactPoint& p : problem.points) p.given = 0;
    const Answer answer = solve(problem);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << problem.kind;
    EXPECT_EQ(answer.F, Vec::Zero(answer.F.size())) << problem.kind;
    EXPECT_EQ(answer.a, Vec::Zero(answer.a.size())) << problem.kind;
  }
}

TEST(Limits, AContactThatJustTouchesLeavesItsTangentAlone) {
  const Mat A{{2, 0.5}, {0.5, 3}};
  Vec F, a;
  const std::vector<ContactPoint> point{
      {.normal = 0, .tangent = 1, .kind = ContactPoint::Tangent::resting, .coefficient = 0.5}};
  ASSERT_EQ(solve_contacts(point, A, Vec{{0, 4}}, F, a).outcome, LcpOutcome::solved);
  EXPECT_EQ(F, Vec::Zero(2));
  EXPECT_EQ(a[1], 4);
}

// A block on its left corner falls back to the floor, its right corner against a wall. Flat but for an angle, that
// corner moves towards the wall by as much of its fall. Within the angle at which rows count as dependent no wedge
// carries: the forces are those of the flat block, whose wall carries nothing.
TEST(Limits, ABlockThatIsFlatButForRoundOffIsNoWedge) {
  std::mt19937 random(54);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double w = 0.1 + 0.4 * part(random), h = w * (0.2 + 0.6 * part(random)), mass = 1 + part(random);
    const double mu_floor = 0.6 + part(random), mu_wall = 0.1 + 0.5 * part(random), gx = part(random);
    const auto forces = [&](double angle) {
      PlanarBodies bodies;
      const Eigen::Rotation2Dd turned(angle);
      const Eigen::Vector2d to_centre = turned * Eigen::Vector2d(w / 2, h / 2);
      const int block = bodies.add(to_centre, mass, mass * (w * w + h * h) / 12, {gx, -9.81, 0});
      bodies.touch(PlanarBodies::ground, block, {0, 0}, {0, 1}, mu_floor);
      bodies.touch(PlanarBodies::ground, block, turned * Eigen::Vector2d(w, 0), {-1, 0}, mu_wall);
      const Problem problem = bodies.problem("a block on a corner");
      const Answer answer = solve(problem);
      EXPECT_EQ(answer.outcome, LcpOutcome::solved) << i << ", " << angle;
      return answer.F;
    };
    const Vec flat = forces(0);
    ASSERT_EQ(flat[2], 0) << i;  // the wall's
    for (const double angle : {1e-12, 1e-10, 1e-9, 3e-9, 1e-8, 3e-8, 1e-7})
      EXPECT_LE((forces(angle) - flat).lpNorm<Eigen::Infinity>(), 10 * angle * flat.lpNorm<Eigen::Infinity>())
          << i << ", " << angle;
  }
}

// Blocks on each other, the middle one sliding, the lowest with its right corner at a wall. Where friction under its
// left corner pulls it away from the wall, the wall carries nothing: accelerations are the same as without it, though a
// wedge between the wall and that corner may be a solution as well.
TEST(Limits, AWallThatNothingMovesAgainstCarriesNothing) {
  std::mt19937 random(55);
  std::uniform_real_distribution<double> part(0, 1);
  int resting = 0;
  for (int i = 0; i < 3000; ++i) {
    PlanarBodies bodies;
    const double gx = 5 * part(random) - 1;
    double y = 0, lowest = 0;
    for (int block = 0; block < 3; ++block) {
      const double w = 0.1 + 0.3 * part(random), h = 0.05 + 0.25 * part(random), mass = 100 * w * h;
      bodies.add({0, y + h / 2}, mass, mass * (w * w + h * h) / 12, {gx, -9, 0});
      const double mu = 0.1 + 0.9 * part(random);
      for (const double x : {-w / 2, w / 2}) {
        bodies.touch(block - 1, block, {x, y}, {0, 1}, mu);
        if (block == 1) bodies.let_slide(-1);
      }
      if (block == 0) lowest = w;
      y += h;
    }
    const Problem free = bodies.problem("a stack");
    bodies.touch(PlanarBodies::ground, 0, {lowest / 2, 0}, {-1, 0}, 0.1 + 0.7 * part(random));
    const Problem problem = bodies.problem("a stack at a wall");
    const Answer alone = solve(free), answer = solve(problem);
    if (alone.outcome != LcpOutcome::solved || alone.a[free.points[0].tangent] != 0) continue;
    if (alone.F[free.points[0].tangent] <= 0) continue;  // the foot and the wall share
    ++resting;
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    EXPECT_LE((answer.a.head(alone.a.size()) - alone.a).lpNorm<Eigen::Infinity>(), little(problem, answer.F)) << i;
  }
  EXPECT_GT(resting, 1000);
}

// Forces in newtons or micronewtons, accelerations in m/s^2 or nm/s^2: the same answer. Of several solutions with
// friction and different accelerations round-off may choose another, about one problem in a thousand of these; then it
// is one as well.
TEST(Limits, UnitsDoNotMatter) {
  std::mt19937 random(52);
  int others = 0;
  for (int i = 0; i < 1000; ++i) {
    const Problem problem = i % 2 ? any_structure(random, 8) : any_planar(random, 1 + i % 8);
    Problem scaled = problem;
    const double forces = 1e6, accelerations = 1e-9;
    scaled.A *= accelerations / forces, scaled.b *= accelerations;
    for (ContactPoint& p : scaled.points) p.given *= forces;
    const Answer answer = solve(problem), other = solve(scaled);
    ASSERT_EQ(answer.outcome, other.outcome) << problem.kind << ", " << i;
    const Vec F = other.F / forces, a = other.a / accelerations;
    const bool same = (F - answer.F).lpNorm<Eigen::Infinity>() <= 1e-8 * F.lpNorm<Eigen::Infinity>() &&
                      (a - answer.a).lpNorm<Eigen::Infinity>() <= little(problem, F);
    if (same || answer.outcome != LcpOutcome::solved) continue;
    ++others;
    EXPECT_LE(offence(problem, F, a), little(problem, F)) << problem.kind << ", " << i;
  }
  EXPECT_LE(others, 5);
}

// Down to a millionth: of small forces no digit is lost beside large ones.
TEST(Limits, LightBodiesOnHeavyOnesAreSolved) {
  std::mt19937 random(54);
  for (int i = 0; i < 1000; ++i) expect_solved(pile_of_discs(random, 2, 0.1 * (1 + i % 15)));
}

TEST(Limits, TallStacksPilesArchesAndTablesAreSolved) {
  std::mt19937 random(53);
  for (const double mu : {0.1, 0.5, 1.0})
    for (const double push : {0.0, 2.0, 9.0}) {
      for (int blocks = 1; blocks <= 20; ++blocks) expect_solved(stack(random, blocks, mu, push, 1));
      for (int feet = 1; feet <= 40; feet += 3) expect_solved(table(random, feet, mu, push));
      for (int rows = 1; rows <= 5; ++rows) expect_solved(pile_of_discs(random, rows, mu));
      for (int voussoirs = 3; voussoirs <= 15; voussoirs += 2)
        for (const double thickness : {0.08, 0.15, 0.3}) expect_solved(arch(voussoirs, mu, thickness));
    }
}

}  // namespace
}  // namespace trammel::complementarity
