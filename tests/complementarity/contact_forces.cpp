// Friction as a complementarity problem: the instances of the reference, and what its degenerate cases end in.
#include "complementarity/contact_forces.hpp"

#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <nlohmann/json.hpp>

namespace trammel::complementarity {
namespace {

using nlohmann::json;
using Tangent = ContactPoint::Tangent;

// Feet at rest under given forces, as caps mu_0 N.
struct Feet {
  Mat A;
  Vec b, cap;
};

struct Answer {
  LcpOutcome outcome;
  Vec F, a;
};

Answer solve(const Feet& feet) {
  std::vector<ContactPoint> points;
  for (int i = 0; i < feet.b.size(); ++i)
    points.push_back({.tangent = i, .kind = Tangent::resting, .coefficient = 1, .given = feet.cap[i]});
  Answer answer;
  answer.outcome = solve_contacts(points, feet.A, feet.b, answer.F, answer.a).outcome;
  return answer;
}

Vec vector_of(const json& list) {
  const std::vector<double> numbers = list;
  return Eigen::Map<const Vec>(numbers.data(), Eigen::Index(numbers.size()));
}

class Reference : public testing::TestWithParam<json> {};

TEST_P(Reference, IsSolved) {
  const json& instance = GetParam();
  Feet feet;
  feet.b = vector_of(instance["b"]), feet.cap = vector_of(instance["cap_mu0_N"]);
  const auto n = feet.b.size();
  feet.A.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) feet.A.row(i) = vector_of(instance["A"][std::size_t(i)]);
  const Answer answer = solve(feet);
  ASSERT_EQ(answer.outcome, LcpOutcome::solved);
  const Vec F = vector_of(instance["F_solutions_by_enumeration"][0]), a = vector_of(instance["accel"][0]);
  const double round_off = 1e-14 * (1 + feet.b.lpNorm<Eigen::Infinity>());
  EXPECT_LT((answer.a - a).lpNorm<Eigen::Infinity>(), round_off);
  const bool singular = std::abs(feet.A.determinant()) < 1e-14;
  // Of a singular matrix only the sum is determined.
  EXPECT_NEAR(answer.F.sum(), F.sum(), round_off);
  EXPECT_TRUE(singular || (answer.F - F).lpNorm<Eigen::Infinity>() < round_off) << answer.F.transpose();
  for (Eigen::Index i = 0; i < n; ++i) EXPECT_LE(std::abs(answer.F[i]), feet.cap[i] + round_off);
}

std::vector<json> instances() {
  std::ifstream in(TRAMMEL_SOURCE_DIR "/tests/data/free_standing.json");
  const json data = json::parse(in);
  return data["lcp_instances"];
}

INSTANTIATE_TEST_SUITE_P(All, Reference, testing::ValuesIn(instances()),
                         [](const auto& instance) { return "n" + std::to_string(instance.index); });

TEST(ContactForces, WithoutNormalForceLeaveTheAccelerationAsItIs) {
  const Answer answer = solve({Mat::Constant(1, 1, 2), Vec::Constant(1, 4), Vec::Zero(1)});
  EXPECT_EQ(answer.F[0], 0);
  EXPECT_EQ(answer.a[0], 4);
}

TEST(ContactForces, ObeyCoulombsLawForRandomFeet) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int repeat = 0; repeat < 300; ++repeat) {
    const int n = 1 + repeat % 6, rank = 1 + repeat % 3;  // often singular
    const Mat J = Mat::NullaryExpr(n, rank, [&] { return normal(random); });
    Feet feet{J * J.transpose(), J * Vec::NullaryExpr(rank, [&] { return 3 * normal(random); }),
              Vec::NullaryExpr(n, [&] { return std::abs(normal(random)); })};
    const Answer answer = solve(feet);
    ASSERT_EQ(answer.outcome, LcpOutcome::solved);
    const Vec a = feet.A * answer.F + feet.b;
    for (int i = 0; i < n; ++i) {
      EXPECT_LE(std::abs(answer.F[i]), feet.cap[i] + 1e-10);  // of numbers near 10
      // Where it slides, the force is on its bound and against the acceleration.
      if (std::abs(a[i]) <= 1e-9) continue;
      EXPECT_NEAR(answer.F[i], std::copysign(feet.cap[i], -a[i]), 1e-9) << repeat;
    }
  }
}

TEST(ContactForces, OfABlockPushedOnAFloorHaveItsWeightAndItsBound) {
  // m = 2, g = 10: N = 20 unilateral, pulled with 9 along the floor; c = 0.5 holds up to 10.
  const Mat A = Mat::Identity(2, 2) / 2;
  Vec F, a;
  std::vector<ContactPoint> foot{{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 0.5}};
  ASSERT_EQ(solve_contacts(foot, A, Vec{{-10, 4.5}}, F, a).outcome, LcpOutcome::solved);
  EXPECT_NEAR(F[0], 20, 1e-14);
  EXPECT_NEAR(F[1], -9, 1e-14);
  foot[0].coefficient = 0.4;  // 8 do not hold 9
  ASSERT_EQ(solve_contacts(foot, A, Vec{{-10, 4.5}}, F, a).outcome, LcpOutcome::solved);
  EXPECT_NEAR(F[1], -8, 1e-14);
  EXPECT_NEAR(a[1], 0.5, 1e-14);
}

TEST(ContactForces, OfPainlevesRodWithTooMuchFrictionHaveNoSolution) {
  // Rod of m = l = 1 at tan(theta) = 2, its tip sliding to -x with mu: p = a_n per N, b = a_n without. p < 0 > b.
  const double s = 2 / std::sqrt(5.0), c = 1 / std::sqrt(5.0), mu = 2;
  const Mat A{{1 + 3 * c * c, -3 * s * c}, {-3 * s * c, 1 + 3 * s * s}};
  EXPECT_NEAR(A(0, 0) + mu * A(0, 1), -0.8, 1e-14);
  Vec F, a;
  const std::vector<ContactPoint> tip{{.normal = 0, .tangent = 1, .kind = Tangent::sliding, .ratio = {mu, 0}}};
  EXPECT_EQ(solve_contacts(tip, A, Vec{{-9.81, 0}}, F, a).outcome, LcpOutcome::no_solution);
  const std::vector<ContactPoint> less{{.normal = 0, .tangent = 1, .kind = Tangent::sliding, .ratio = {1.3, 0}}};
  ASSERT_EQ(solve_contacts(less, A, Vec{{-9.81, 0}}, F, a).outcome, LcpOutcome::solved);
  EXPECT_NEAR(F[0], 245.25, 1e-10);
}

// A foot of 10 N, which the acceleration asked for exceeds by 1e-9 of its friction, beside a light body in the same
// island that is pushed 10^4 times as hard: what it begins to slide with is far below round-off of the other's.
TEST(ContactForces, OfAFootThatBeginsToSlideAreFoundBesideALightBodyUnderALargeLoad) {
  Mat A = Mat::Identity(3, 3);
  A(0, 2) = A(2, 0) = 0.1;
  const std::vector<ContactPoint> points{{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 0.5},
                                         {.normal = 2}};
  const double light = 1e5;  // [1/kg]
  A(2, 2) = light;
  Vec F, a;
  for (const double excess : {5e-9, -5e-9}) {
    const Vec b{{-10 - 0.1, 5 + excess, -light - 1}};
    ASSERT_EQ(solve_contacts(points, A, b, F, a).outcome, LcpOutcome::solved);
    EXPECT_NEAR(F[0], 10, 1e-10);
    EXPECT_NEAR(F[1], -5 - std::min(excess, 0.0), 1e-10);
    EXPECT_NEAR(a[1], std::max(excess, 0.0), 1e-10);
  }
}

}  // namespace
}  // namespace trammel::complementarity
