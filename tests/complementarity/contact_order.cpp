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

// Two blocks in a channel strike with both corners of their sides: turned upside down it is the same problem, with
// solutions of which friction drives some up and some down.
Problem struck_in_a_channel(double mu_between, double mass, double slip) {
  constexpr double w = 0.08, h = 0.11;
  PlanarBodies bodies;
  for (const auto& [x, m] : {std::pair{0.0, 1.0}, {w, mass}}) {
    const int body = bodies.add({x, 0}, m, m * (w * w + h * h) / 12, {x == 0 ? 1.0 : 0.0, 0, 0});
    for (const double side : {-1.0, 1.0})
      for (const double end : {-1.0, 1.0}) {
        bodies.touch(PlanarBodies::ground, body, {x + end * w / 2, side * h / 2}, {0, -side}, 0.5);
        if (slip != 0 && x == 0) bodies.let_slide(side < 0 ? 1 : -1);
      }
  }
  for (const double side : {-1.0, 1.0}) bodies.touch(0, 1, {w / 2, side * h / 2}, {1, 0}, mu_between);
  return bodies.problem("struck in a channel");
}

TEST(ContactOrder, DoesNotMatterWhereCornersDifferByTheirSidesAlone) {
  std::mt19937 random(33);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  for (int i = 0; i < 200; ++i)
    expect_same_in_any_order(random, struck_in_a_channel(any(0.1, 0.6), any(0.2, 8), double(i % 2)), i);
}

}  // namespace
}  // namespace trammel::complementarity
