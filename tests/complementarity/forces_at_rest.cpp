// A box that a moment has wedged in between floor and ceiling while it slid: which forces it rests with where its slip
// ends and the moment, too.
#include <cmath>
#include <limits>
#include <random>
#include <vector>

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

ContactPoint resting(int normal, int tangent, int tangents, double mu) {
  ContactPoint p;
  p.normal = normal, p.tangent = tangent, p.tangents = tangents, p.kind = ContactPoint::Tangent::resting;
  p.coefficient = mu;
  return p;
}

// A pad whose force is given, at the centre, holds what exceeds the push that the strut holds; another one rubs with
// coefficient 0. The rows of the pads are the first.
TEST(ForcesAtRest, ContainTheFrictionOfGivenForces) {
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const Strut s = any_strut(random);
    const double pressed = between(random, 0.1, 1) * s.weight(), held = between(random, 0.1, 0.9) * s.mu * pressed;
    const double J = s.m * (s.a * s.a + s.b * s.b) / 3;
    Mat G(10, 3);                                         // x, y, rotation
    G << 1, 0, 0, 1, 0, 0,                                // pads
        0, 1, -s.a, 1, 0, s.b, 0, 1, s.a, 1, 0, s.b,      // floor: normal and tangent of each corner
        0, -1, s.a, 1, 0, -s.b, 0, -1, -s.a, 1, 0, -s.b;  // ceiling
    std::vector<ContactPoint> points{resting(-1, 0, 1, s.mu), resting(-1, 1, 1, 0)};
    points[0].given = points[1].given = pressed;
    for (int corner = 0; corner < 4; ++corner) points.push_back(resting(2 + 2 * corner, 3 + 2 * corner, 1, s.mu));
    const Mat A = G * Vec{{1 / s.m, 1 / s.m, 1 / J}}.asDiagonal() * G.transpose();
    const Vec b = G * Vec{{(s.most() + held) / s.m, -g, 0}};
    Vec N = Vec::Zero(10);
    N[4] = (s.S + s.weight()) / 2, N[6] = (s.S - s.weight()) / 2;
    const auto F = forces_at_rest(points, A, b, N);
    ASSERT_TRUE(F) << i;
    EXPECT_LE((A * *F + b).lpNorm<Eigen::Infinity>(), accurate * b.norm()) << i;
    EXPECT_LE(std::abs((*F)[0]), s.mu * pressed * (1 + accurate)) << i;
    for (const int normal : {2, 4, 6, 8}) EXPECT_NEAR((*F)[normal], N[normal], accurate * s.S) << i;
    points[0].given = 0;
    const auto without = forces_at_rest(points, A, b, N);
    EXPECT_TRUE(!without || std::abs((*without)[4] - N[4]) > 1e-3 * held) << i;
  }
}

// The same in space: friction also holds a push across the plane of the strut, half of it at each end.
TEST(ForcesAtRest, HoldAStrutInSpaceAgainstAPushAcrossIt) {
  std::mt19937 random(8);
  for (int i = 0; i < 20; ++i) {
    const Strut s = any_strut(random);
    const double J = s.m * (s.a * s.a + s.b * s.b) / 3, across = between(random, 0.01, 0.1) * s.weight();
    const double push = (s.least() + s.most()) / 2;
    Mat G = Mat::Zero(12, 6);  // x, y, z, rotations
    Vec N = Vec::Zero(12);
    std::vector<ContactPoint> points;
    for (int corner = 0; corner < 4; ++corner) {
      const double x = corner % 2 ? s.a : -s.a, y = corner < 2 ? -s.b : s.b, up = corner < 2 ? 1 : -1;
      const int row = 3 * corner;
      G(row, 1) = up, G(row, 5) = up * x;
      G(row + 1, 0) = 1, G(row + 1, 5) = -y;
      G(row + 2, 2) = 1, G(row + 2, 3) = y, G(row + 2, 4) = -x;
      points.push_back(resting(row, row + 1, 2, s.mu));
    }
    N[3] = (s.S + s.weight()) / 2, N[6] = (s.S - s.weight()) / 2;
    const Mat A = G * Vec{{1 / s.m, 1 / s.m, 1 / s.m, 1 / J, 1 / J, 1 / J}}.asDiagonal() * G.transpose();
    const Vec b = G * Vec{{push / s.m, -g, across / s.m, 0, 0, 0}};
    const auto F = forces_at_rest(points, A, b, N);
    ASSERT_TRUE(F) << i;
    EXPECT_LE((A * *F + b).lpNorm<Eigen::Infinity>(), accurate * b.norm()) << i;
    for (const int corner : {1, 2}) {
      EXPECT_NEAR((*F)[3 * corner], N[3 * corner], accurate * s.S) << i;
      EXPECT_NEAR((*F)[3 * corner + 2], -across / 2, accurate * s.S) << i;
    }
  }
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
