// Two blocks on a floor, one pushed against the other: what their friction against each other carries of the second
// one's weight decides the motion, where they slide on the floor by different coefficients. They share as equal springs
// do, with what springs' shares would let pull idle, and what they would hold beyond its cone at its bound.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "planar_bodies.hpp"

namespace trammel::complementarity {
namespace {

Problem pushed_blocks(std::mt19937& random) {
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  PlanarBodies bodies;
  const double h_0 = any(0.1, 0.3), h_1 = any(0.1, 0.3), push = any(2, 15);
  double left = 0;
  for (int i = 0; i < 2; ++i) {
    const double w = any(0.08, 0.3), h = i == 0 ? h_0 : h_1, m = std::pow(10, any(-0.5, 0.5));
    const double inertia = m * (w * w + h * h) / 12, arm = any(-0.3, 0.3) * h;  // of the push, below the centre
    bodies.add({left + w / 2, h / 2}, m, inertia, {i == 0 ? push : 0, -10, i == 0 ? m * push * arm / inertia : 0});
    const double mu = any(0.1, 0.6);
    for (const double x : {left, left + w}) bodies.touch(PlanarBodies::ground, i, {x, 0}, {0, 1}, mu);
    left += w;
    if (i > 0) continue;
    const double mu_between = any(0.1, 0.6);
    for (const double y : {0.0, std::min(h_0, h_1)}) bodies.touch(0, 1, {left, y}, {1, 0}, mu_between);
  }
  return bodies.problem("pushed blocks");
}

// But not all that press: those then share by the least admissible forces, which springs with friction do not have.
bool some_are_at_bounds(const Problem& problem, const Vec& F) {
  bool bound = false, within = false;
  for (const ContactPoint& p : problem.points) {
    const double T = std::abs(F[p.tangent]), most = p.coefficient * F[p.normal];
    if (F[p.normal] > 0) (T > (1 - 1e-6) * most ? bound : within) = true;
  }
  return bound && within;
}

TEST(BlocksInTandem, ShareAsStiffSpringsDoAlsoWhereThoseAreIdleOrAtTheirBounds) {
  std::mt19937 random(2190);
  int slide = 0, idle = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem rigid = pushed_blocks(random);
    Problem stiff = rigid;
    const double soft = 1e-7;
    stiff.A.diagonal().array() += soft * rigid.A.diagonal().maxCoeff();
    const Answer answer = solve(rigid), springs = solve(stiff);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved) << i;
    ASSERT_EQ(springs.outcome, LcpOutcome::solved) << i;
    EXPECT_LE(offence(rigid, answer.F, answer.a), little(rigid, answer.F)) << i;
    const bool slides = std::abs(answer.a[1]) > 1e-3;
    if (!slides || some_are_at_bounds(rigid, springs.F)) continue;
    EXPECT_LE((answer.F - springs.F).norm(), 1e3 * soft * springs.F.norm()) << i << "\n"
                                                                            << answer.F.transpose() << "\n"
                                                                            << springs.F.transpose();
    ++slide;
    for (const ContactPoint& p : rigid.points) idle += answer.F[p.normal] == 0 && answer.a[p.normal] == 0;
  }
  EXPECT_GT(slide, 300);
  EXPECT_GT(idle, 20);
}

}  // namespace
}  // namespace trammel::complementarity
