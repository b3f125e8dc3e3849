// Of several solutions, the one near a solution that is known is found.
#include <gtest/gtest.h>

#include "planar_bodies.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

ContactPoint sliding(int normal, double ratio) {
  ContactPoint p;
  p.normal = normal, p.tangent = normal + 1, p.tangents = 1;
  p.kind = ContactPoint::Tangent::sliding;
  p.ratio[0] = ratio;
  return p;
}

// The friction of each contact pushes the other one open: a_1 = N_1 + 2 N_2 - b_1, a_2 = 2 N_1 + N_2 - b_2.
TEST(NearbySolution, IsContinuedWhicheverOfThreeItIs) {
  constexpr double coupling = 0.5, ratio = 2 / coupling;
  const std::vector<ContactPoint> points{sliding(0, ratio), sliding(2, ratio)};
  Mat A = Mat::Identity(4, 4);
  A(0, 3) = A(3, 0) = A(1, 2) = A(2, 1) = coupling;
  for (const Vec& N : {Vec{{1, 0}}, Vec{{0, 1}}, Vec{{1. / 3, 1. / 3}}}) {
    const Vec F_near{{N[0], ratio * N[0], N[1], ratio * N[1]}};
    const auto solved = [&](const Vec& b, Vec& F, Vec& a) {
      std::vector<double> violation;
      return solve_contacts(points, A, b, F, a, {0, 0}, violation, {{F_near, A * F_near + Vec{{-1, 0, -1, 0}}}})
          .outcome;
    };
    for (const double more : {-1e-2, 0.0, 1e-2}) {
      Vec F, a;
      ASSERT_EQ(solved(Vec{{-1 - more, 0, -1 + more, 0}}, F, a), LcpOutcome::solved);
      EXPECT_LE((F(std::vector{0, 2}) - N).norm(), 3 * std::abs(more) + 1e-14) << N.transpose() << ", " << more;
    }
  }
}

Vec random_vector(std::mt19937& random, Eigen::Index n) {
  std::normal_distribution<double> normal;
  return Vec::NullaryExpr(n, [&] { return normal(random); });
}

// It is where the search begins, and nothing else.
TEST(NearbySolution, MayBeNone) {
  std::mt19937 random(51);
  for (int i = 0; i < 1000; ++i) {
    const Problem problem = i % 2 == 0 ? any_planar(random, 2 + i % 7) : any_structure(random, 8);
    const Answer alone = solve(problem);
    if (alone.outcome != LcpOutcome::solved) continue;
    const double F_scale = alone.F.lpNorm<Eigen::Infinity>(), a_scale = problem.b.lpNorm<Eigen::Infinity>();
    const NearbySolution none{F_scale * random_vector(random, problem.b.size()),
                              a_scale * random_vector(random, problem.b.size())};
    Vec F, a;
    std::vector<double> violation;
    const std::vector<double> nothing(problem.points.size(), 0);
    const ContactSolution found =
        solve_contacts(problem.points, problem.A, problem.b, F, a, nothing, violation, {none});
    ASSERT_EQ(found.outcome, LcpOutcome::solved) << problem.kind << ", " << i;
    EXPECT_LE(found.violation, largest_violation) << problem.kind << ", " << i;
  }
}

}  // namespace
}  // namespace trammel::complementarity
