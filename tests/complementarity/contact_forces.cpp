// Friction as a complementarity problem: the instances of the reference, and what its degenerate cases end in.
#include "complementarity/contact_forces.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <utility>

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

// A body between two walls that approach each other by `closing`, the first one with 10.
struct Squeezed {
  std::vector<ContactPoint> walls{{.normal = 0}, {.normal = 1}};
  Mat A{{1, -1}, {-1, 1}};
  Vec b;
  explicit Squeezed(double closing) : b(Vec{{-10, 10 - closing}}) {}
  LcpOutcome solve(const std::vector<double>& nothing, Vec& F, Vec& a) const {
    std::vector<double> violation;
    return solve_contacts(walls, A, b, F, a, nothing, violation).outcome;
  }
};

// The largest acceleration that counts as none in an island is that of any of its contacts.
TEST(ContactForces, MayDisagreeByWhatCountsAsNothing) {
  const Squeezed squeezed(1e-6);
  Vec F, a;
  for (const std::vector<double>& nothing : {std::vector{1e-5, 0.0}, {0.0, 1e-5}})
    EXPECT_EQ(squeezed.solve(nothing, F, a), LcpOutcome::solved);
  EXPECT_NEAR(F[0] - F[1], 10, 1e-5);
  EXPECT_EQ(squeezed.solve({0, 0}, F, a), LcpOutcome::gave_up);
}

TEST(ContactForces, ViolateTheConditionsAsMuchAsTheWorstIslandDoes) {
  for (const bool squeezed_first : {true, false}) {
    const Squeezed squeezed(1e-6);
    Mat A = Mat::Identity(3, 3);
    Vec b = Vec::Constant(3, -5), F, a;
    const int at = squeezed_first ? 0 : 1;
    A.block(at, at, 2, 2) = squeezed.A, b.segment(at, 2) = squeezed.b;
    const std::vector<ContactPoint> points{{.normal = 0}, {.normal = 1}, {.normal = 2}, {.given = 3}};
    std::vector<double> violation;
    const ContactSolution found = solve_contacts(points, A, b, F, a, {1e-5, 1e-5, 1e-5, 0}, violation);
    ASSERT_EQ(found.outcome, LcpOutcome::solved);
    EXPECT_GT(found.violation, 1e-11);
    EXPECT_EQ(found.violation, violation[std::size_t(at)]);
    EXPECT_EQ(violation[std::size_t(at)], violation[std::size_t(at) + 1]);
    EXPECT_LE(violation[squeezed_first ? 2 : 0], 1e-15);
    EXPECT_EQ(violation[3], 0);  // it has no row
    EXPECT_NEAR(F[squeezed_first ? 2 : 0], 5, 1e-14);
  }
}

TEST(ContactForces, AreZeroIfOneIslandHasNoSolution) {
  const Squeezed squeezed(1);
  Mat A = Mat::Identity(3, 3);
  Vec b = Vec::Constant(3, -5), F, a;
  A.bottomRightCorner(2, 2) = squeezed.A, b.tail(2) = squeezed.b;
  EXPECT_EQ(solve_contacts({{.normal = 0}, {.normal = 1}, {.normal = 2}}, A, b, F, a).outcome, LcpOutcome::no_solution);
  EXPECT_EQ(F, Vec::Zero(3));
  EXPECT_EQ(a, Vec::Zero(3));
}

TEST(ContactForces, OfNoContactsOrOfWhatIsNoNumberAreNone) {
  Vec F, a;
  const ContactSolution none = solve_contacts({}, Mat(0, 0), Vec(0), F, a);
  EXPECT_EQ(none.outcome, LcpOutcome::solved);
  EXPECT_EQ(none.violation, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [A, b] : {std::pair(1.0, nan), std::pair(nan, -1.0)}) {
    const ContactSolution found = solve_contacts({{.normal = 0}}, Mat{{A}}, Vec{{b}}, F, a);
    EXPECT_EQ(found.outcome, LcpOutcome::gave_up);
    EXPECT_TRUE(std::isinf(found.violation));
    EXPECT_EQ(F, Vec::Zero(1));
  }
}

// A foot of c N = 1 under a given force, pushed along its only row.
TEST(ContactForces, OfAFootAtRestLeaveNoAccelerationAndKeepWithinTheirBound) {
  const std::vector<ContactPoint> foot{{.tangent = 0, .kind = Tangent::resting, .coefficient = 0.5, .given = 2}};
  Vec F, a;
  for (int i = 1; i <= 30; ++i) {
    const double push = 0.1 * i;
    ASSERT_EQ(solve_contacts(foot, Mat{{3}}, Vec{{-push}}, F, a).outcome, LcpOutcome::solved);
    EXPECT_NEAR(F[0], push / 3, 1e-15);
    EXPECT_EQ(a[0], 0) << push;
    EXPECT_LE(F[0], 1);
  }
  ASSERT_EQ(solve_contacts(foot, Mat{{3}}, Vec{{-3 * (1 + 1e-14)}}, F, a).outcome, LcpOutcome::solved);
  EXPECT_EQ(F[0], 1);
  EXPECT_EQ(a[0], 0);
}

// To 1e-13 of the accelerations of its island, 200.
TEST(ContactForces, ThatRoundOffWouldExplainAreNone) {
  const std::vector<ContactPoint> points{{.normal = 0}, {.normal = 1}};
  const Mat A{{1, 0.5}, {0.5, 1}};
  Vec F, a;
  for (const auto& [small, left] : {std::pair(1e-11, 0.0), std::pair(4e-11, 4e-11)}) {
    ASSERT_EQ(solve_contacts(points, A, -A * Vec{{100, small}}, F, a).outcome, LcpOutcome::solved);
    EXPECT_NEAR(F[1], left, left * 1e-3);
    EXPECT_EQ(a, Vec::Zero(2));
  }
}

// a_n = (2 - p) N - 10. Where N = 1e14 the round-off of its terms would be as large as a part of 10.
TEST(ContactForces, ThatCancelBeyondRoundOffAreNoSolution) {
  const auto solved = [](double left, Vec& F) {
    Vec a;
    const std::vector<ContactPoint> slides{
        {.normal = 0, .tangent = 1, .kind = Tangent::sliding, .ratio = {-(2 - left), 0}}};
    return solve_contacts(slides, Mat{{2, 1}, {1, 3}}, Vec{{-10, 0}}, F, a).outcome == LcpOutcome::solved;
  };
  Vec F;
  ASSERT_TRUE(solved(1.0 / 1024 / 1024 / 1024, F));
  EXPECT_NEAR(F[0] / (10.0 * 1024 * 1024 * 1024), 1, 1e-6);
  EXPECT_FALSE(solved(std::pow(2, -44), F));
}

}  // namespace
}  // namespace trammel::complementarity
