// The exact forces near others, by themselves: what is started from need not be a solution.
#include "complementarity/exact_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;

// 2 N = 10, and T holds up to 2.5 of what pushes along the tangent, with 3 T.
struct Foot {
  std::vector<ContactPoint> points{{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 0.5}};
  Mat A = Mat(Eigen::Vector2d(2, 3).asDiagonal());
};

struct Exact {
  bool found = false;
  Vec F, a;
};
Exact exact_near(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& near) {
  Exact exact{.F = near, .a = A * near + b};
  exact.found = make_exact(points, A, b, 1e-8, exact.F, exact.a);
  return exact;
}

TEST(ExactModes, OfAFootAreFoundWhereverTheSearchBegins) {
  const Foot foot;
  const Vec starts[] = {Vec{{0, 0}}, Vec{{5, -2}}, Vec{{5, 2.5}}, Vec{{5, -2.5}}, Vec{{-5, 0}}, Vec{{1e3, 1e3}}};
  for (const Vec& start : starts) {
    SCOPED_TRACE(start.transpose());
    const Exact held = exact_near(foot.points, foot.A, Vec{{-10, 6}}, start);
    ASSERT_TRUE(held.found);
    EXPECT_LE((held.F - Vec{{5, -2}}).norm() + held.a.norm(), 1e-14);
    const Exact slips = exact_near(foot.points, foot.A, Vec{{-10, 9}}, start);
    ASSERT_TRUE(slips.found);
    EXPECT_LE((slips.F - Vec{{5, -2.5}}).norm() + (slips.a - Vec{{0, 1.5}}).norm(), 1e-14);
    const Exact parts = exact_near(foot.points, foot.A, Vec{{1, 9}}, start);
    ASSERT_TRUE(parts.found);
    EXPECT_LE(parts.F.norm() + (parts.a - Vec{{1, 9}}).norm(), 1e-14);
  }
}

TEST(ExactModes, HaveNoForceWhereAKnownSlipHasNone) {
  ContactPoint slides{.normal = 0, .tangent = 1, .kind = Tangent::sliding};
  const Mat A{{2, 1}, {1, 3}};
  slides.ratio[0] = -1;  // a_n = (2 - 1) N - 10
  const Exact exact = exact_near({slides}, A, Vec{{-10, 0}}, Vec{{9, -9}});
  ASSERT_TRUE(exact.found);
  EXPECT_LE((exact.F - Vec{{10, -10}}).norm(), 1e-13);
  slides.ratio[0] = -2;  // Painleve's critical coefficient: a_n = 0 N - 10
  EXPECT_FALSE(exact_near({slides}, A, Vec{{-10, 0}}, Vec{{9, -18}}).found);
}

// Starts with an error of 1e-9 in each force.
TEST(ExactModes, RemoveTheErrorOfANearbySolution) {
  std::mt19937 random(81);
  int exact = 0, same = 0;
  for (int i = 0; i < 400; ++i) {
    const Problem problem = i % 2 ? any_structure(random, 6) : random_planar(random, {.contacts = 1 + i % 6});
    const Answer answer = solve(problem);
    if (answer.outcome != LcpOutcome::solved) continue;
    const double size = 1e-9 * answer.F.lpNorm<Eigen::Infinity>();
    std::normal_distribution<double> normal;
    Vec F = answer.F + size * Vec::NullaryExpr(answer.F.size(), [&] { return normal(random); }), a = answer.a;
    if (!make_exact(problem.points, problem.A, problem.b, 1e-8, F, a)) continue;
    ++exact;
    same += (a - answer.a).lpNorm<Eigen::Infinity>() <= little(problem, F);
    EXPECT_LE(violation(problem.points, problem.A, problem.b, F), 1e-11) << problem.kind << ", " << i;
  }
  EXPECT_GT(exact, 350);
  EXPECT_GE(same, exact - 3);  // with friction there may be several
}

// Without friction every start leads to the accelerations, which are unique: contacts close and open one at a time.
TEST(ExactModes, WithoutFrictionHaveTheAccelerationsWhateverTheStart) {
  std::mt19937 random(82);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const int n = 1 + i % 8;
    const Problem problem = random_normals(random, n, n + 2, 0);
    const Answer answer = solve(problem);
    std::normal_distribution<double> normal;
    Vec near = Vec::NullaryExpr(n, [&] { return std::max(0.0, normal(random)); });
    const Exact exact = exact_near(problem.points, problem.A, problem.b, near);
    if (!exact.found) continue;
    ++found;
    EXPECT_LE((exact.a - answer.a).lpNorm<Eigen::Infinity>(), little(problem, exact.F)) << i;
    EXPECT_LE((exact.F - answer.F).lpNorm<Eigen::Infinity>(), 1e-9 * (1 + exact.F.lpNorm<Eigen::Infinity>())) << i;
  }
  EXPECT_GT(found, 290);
}

}  // namespace
}  // namespace trammel::complementarity
