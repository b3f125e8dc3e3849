// A box that a moment has wedged in between floor and ceiling while it slid: which forces it rests with where its slip
// ends and the moment, too.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "complementarity/forces_at_rest.hpp"
#include "planar_bodies.hpp"
#include "support/between.hpp"

namespace trammel::complementarity {
namespace {

using test::between;

constexpr double g = 10, accurate = 1e-9;

// Its lower right and its upper left corner press with N_floor + N_ceiling = S and N_floor - N_ceiling = m g.
struct Strut {
  double a, b, m, mu, S;  // half of its sides [m], [kg], [1], [N]
  double weight() const { return m * g; }
  // Friction -F/2 -+ a S/(2 b) holds a push F: that of the floor up to the one of these, that of the ceiling from the
  // other on.
  double most() const { return mu * (S + weight()) - a * S / b; }
  double least() const { return a * S / b - mu * (S - weight()); }
  Problem pushed(double F) const {
    PlanarBodies bodies;
    const int box = bodies.add({0, 0}, m, m * (a * a + b * b) / 3, {F / m, -g, 0});
    for (const double x : {-a, a}) bodies.touch(PlanarBodies::ground, box, {x, -b}, {0, 1}, mu);
    for (const double x : {-a, a}) bodies.touch(PlanarBodies::ground, box, {x, b}, {0, -1}, mu);
    return bodies.problem("strut");
  }
  Vec N(const Problem& problem) const {
    Vec N = Vec::Zero(problem.b.size());
    N[problem.points[1].normal] = (S + weight()) / 2, N[problem.points[2].normal] = (S - weight()) / 2;
    return N;
  }
};

Strut any_strut(std::mt19937& random) {
  Strut s{};
  s.mu = between(random, 0.5, 0.9), s.b = between(random, 0.5, 1), s.a = s.b * s.mu * between(random, 0.3, 0.7);
  s.m = between(random, 0.5, 3), s.S = between(random, 2.5, 6) * s.weight();
  return s;
}

double any_push(std::mt19937& random, const Strut& s) {
  return s.least() + between(random, 0.001, 0.999) * (s.most() - s.least());
}

TEST(ForcesAtRest, AreThoseWithWhichAStrutWasWedgedIn) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Strut s = any_strut(random);
    const Problem problem = s.pushed(any_push(random, s));
    const auto F = forces_at_rest(problem.points, problem.A, problem.b, s.N(problem));
    ASSERT_TRUE(F) << i;
    EXPECT_LE((problem.A * *F + problem.b).lpNorm<Eigen::Infinity>(), accurate * problem.b.norm()) << i;
    for (const ContactPoint& p : problem.points)
      EXPECT_NEAR((*F)[p.normal], s.N(problem)[p.normal], accurate * s.S) << i;
  }
}

// If any: springs that have moved on.
TEST(ForcesAtRest, AreOthersBeyondThePushThatAStrutHolds) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const Strut s = any_strut(random);
    const Problem problem = s.pushed((1 + 1e-6) * s.most());
    const auto F = forces_at_rest(problem.points, problem.A, problem.b, s.N(problem));
    const Vec N = s.N(problem);
    const Eigen::Index floor = problem.points[1].normal;
    EXPECT_TRUE(!F || std::abs((*F)[floor] - N[floor]) > 1e-3 * s.S) << i;
  }
}

TEST(ForcesAtRest, AreNoneIfAContactSlidesOrAForceIsUnknown) {
  std::mt19937 random(5);
  const Strut s = any_strut(random);
  Problem problem = s.pushed((s.least() + s.most()) / 2);
  Vec N = s.N(problem);
  ASSERT_TRUE(forces_at_rest(problem.points, problem.A, problem.b, N));
  N[problem.points[0].normal] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(forces_at_rest(problem.points, problem.A, problem.b, N));
  problem.points[0].kind = ContactPoint::Tangent::sliding;
  EXPECT_FALSE(forces_at_rest(problem.points, problem.A, problem.b, s.N(problem)));
}

// It could also slide back: without the forces until now, either motion may be found.
TEST(Rest, CountsWhereAStrutCouldAlsoSlideBack) {
  std::mt19937 random(6);
  int other = 0;
  for (int i = 0; i < 50; ++i) {
    const Strut s = any_strut(random);
    const Problem problem = s.pushed(any_push(random, s));
    const std::vector<double> nothing(problem.points.size(), 0);
    std::vector<double> each;
    Vec F, a;
    ASSERT_EQ(solve_contacts(problem.points, problem.A, problem.b, F, a, nothing, each, {{}, s.N(problem)}).outcome,
              LcpOutcome::solved);
    EXPECT_LE(a.lpNorm<Eigen::Infinity>(), little(problem, F)) << i;
    EXPECT_LE(offence(problem, F, a), little(problem, F)) << i;
    if (solve(problem).a.lpNorm<Eigen::Infinity>() > little(problem, F)) ++other;
  }
  EXPECT_GT(other, 0);
}

}  // namespace
}  // namespace trammel::complementarity
