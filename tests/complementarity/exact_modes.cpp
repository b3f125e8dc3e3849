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
// `a` of the start decides, with its forces, from which modes the search begins.
Exact exact_from(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& F, const Vec& a) {
  Exact exact{.F = F, .a = a};
  exact.found = make_exact(points, A, b, 1e-8, exact.F, exact.a);
  return exact;
}
Exact exact_near(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& near) {
  return exact_from(points, A, b, near, A * near + b);
}

std::vector<ContactPoint> normals(int n) {
  std::vector<ContactPoint> points;
  for (int i = 0; i < n; ++i) points.push_back({.normal = i});
  return points;
}

using Role = ContactRole;

// Three frictionless contacts that act on nothing but themselves.
std::vector<Role> roles_of_normals(const Vec& F, const Vec& a, double nothing) {
  return roles_of(normals(int(F.size())), F, a, nothing);
}

// A force of round-off beside the largest one is none.
TEST(RolesOf, AContactIsClosedWhereItPressesOrDoesNotPart) {
  const auto closed = [](const Vec& F, const Vec& a, double nothing) {
    std::vector<bool> all;
    for (const Role& role : roles_of_normals(F, a, nothing)) all.push_back(role.closed);
    return all;
  };
  using Expected = std::vector<bool>;
  EXPECT_EQ(closed(Vec{{0, 1e3, 1.1e-9, 0.9e-9}}, Vec{{1, 1, 1, 1}}, 0.5), (Expected{false, true, true, false}));
  EXPECT_EQ(closed(Vec{{0, 1e-3, 1.1e-15, 0.9e-15}}, Vec{{1, 1, 1, 1}}, 0.5), (Expected{false, true, true, false}));
  EXPECT_EQ(closed(Vec{{0, 0, 0}}, Vec{{0.5, 0.6, -1}}, 0.5), (Expected{true, false, true}));
  EXPECT_EQ(closed(Vec{{0, 0}}, Vec{{0, 1e-300}}, 0), (Expected{true, false}));
}

// Feet of c = 0.25 that press with 4: they hold up to 1.
TEST(RolesOf, AFootSlidesIfItMovesFasterThanWhatCountsAsRest) {
  const std::vector<ContactPoint> feet{
      {.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.25},
      {.normal = 3, .tangent = 4, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.25}};
  const Vec F{{4, 0, 0, 4, 0, 0}}, a{{0, 3, 4, 0, 3, 4}};
  const auto tangents = [&](const Vec& no_slip) {
    const std::vector<Role> roles = roles_of(feet, F, a, 1, no_slip);
    return std::pair(roles[0].tangent, roles[1].tangent);
  };
  EXPECT_EQ(tangents(Vec{{5, 4.9}}), (std::pair(Role::Tangent::sticks, Role::Tangent::slides)));
  EXPECT_EQ(tangents(Vec{{4.9, 5}}), (std::pair(Role::Tangent::slides, Role::Tangent::sticks)));
  EXPECT_EQ(roles_of(feet, F, a, 5)[1].tangent, Role::Tangent::sticks);
  EXPECT_EQ(roles_of(feet, F, a, 4.9)[0].tangent, Role::Tangent::slides);
  EXPECT_EQ(roles_of(feet, F, Vec::Zero(6), 0)[0].tangent, Role::Tangent::sticks);
  EXPECT_EQ(roles_of(feet, F, Vec{{1, 0, 0, 1, 0, 0}}, 0)[0].tangent, Role::Tangent::sticks);  // it presses
}

// From half of its bound on; below, and where it does not press, friction acts against the slip.
TEST(RolesOf, AFootSlidesAlongItsFrictionWhereThatIsNearItsBound) {
  const std::vector<ContactPoint> foot{
      {.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.25}};
  const Vec a{{0, -2, 0}};
  const auto ratio = [&](const Vec& F) { return roles_of(foot, F, a, 1)[0].ratio; };
  const Eigen::Vector2d along_friction = 0.25 * Eigen::Vector2d(0.6, 0.8), against_slip(0.25, 0);
  EXPECT_LE((ratio(Vec{{4, 0.51 * 0.6, 0.51 * 0.8}}) - along_friction).norm(), 1e-16);
  EXPECT_LE((ratio(Vec{{4, 0.49 * 0.6, 0.49 * 0.8}}) - against_slip).norm(), 1e-16);
  EXPECT_LE((ratio(Vec{{4, 0, 0.5}}) - against_slip).norm(), 1e-16);
  EXPECT_LE((ratio(Vec{{0, 0.6, 0.8}}) - against_slip).norm(), 1e-16);
  EXPECT_LE((ratio(Vec{{1e-12, 0, 1}}) - against_slip).norm(), 1e-16);  // a force of round-off
  EXPECT_EQ(roles_of(foot, Vec{{4, 0, 0}}, Vec::Zero(3), 1)[0].ratio, Eigen::Vector2d(0, 0));
}

TEST(RolesOf, AKnownSlipKeepsItsRatioAndAGivenForceIsClosed) {
  const std::vector<ContactPoint> points{{.normal = 0, .tangent = 1, .kind = Tangent::sliding, .ratio = {-0.3, 0}},
                                         {.tangent = 2, .kind = Tangent::resting, .coefficient = 0.5, .given = 4},
                                         {.tangent = 3, .kind = Tangent::resting, .coefficient = 0, .given = 4},
                                         {.kind = Tangent::sliding, .given = 4}};
  const auto roles = [&](const Vec& a) { return roles_of(points, Vec::Zero(4), a, 0); };
  const Role slides{.closed = true, .tangent = Role::Tangent::slides, .ratio = {-0.3, 0}};
  const Role pushed{.closed = true, .tangent = Role::Tangent::slides, .ratio = {-0.5, 0}};
  const Role sticks{.closed = true, .tangent = Role::Tangent::sticks}, closed{.closed = true};
  EXPECT_EQ(roles(Vec::Zero(4)), (std::vector<Role>{slides, sticks, closed, closed}));
  EXPECT_EQ(roles(Vec{{0, 1, 1, 1}}), (std::vector<Role>{slides, pushed, closed, closed}));
  EXPECT_EQ(roles(Vec{{1, 1, 1, 1}})[0], Role());
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

TEST(ExactModes, OpenAndCloseAsManyContactsAsThereAre) {
  const int n = 40;
  const Mat A = Mat::Identity(n, n);
  const Vec presses = Vec::LinSpaced(n, 1, 2), parts = -presses, one = Vec::Ones(n);
  const Exact closed = exact_from(normals(n), A, -presses, Vec::Zero(n), one);
  ASSERT_TRUE(closed.found);
  EXPECT_EQ(closed.F, presses);
  const Exact open = exact_from(normals(n), A, -parts, one, Vec::Zero(n));
  ASSERT_TRUE(open.found);
  EXPECT_EQ(open.F, Vec::Zero(n));
  EXPECT_EQ(open.a, presses);
}

TEST(ExactModes, OfAFootThatClosesHoldItOrLetItSlide) {
  const Foot foot;
  const Vec none = Vec::Zero(2), parts{{1, 0}};
  const Exact holds = exact_from(foot.points, foot.A, Vec{{-10, 6}}, none, parts);
  ASSERT_TRUE(holds.found);
  EXPECT_LE((holds.F - Vec{{5, -2}}).norm() + holds.a.norm(), 1e-14);
  const Exact slips = exact_from(foot.points, foot.A, Vec{{-10, 9}}, none, parts);
  ASSERT_TRUE(slips.found);
  EXPECT_LE((slips.F - Vec{{5, -2.5}}).norm() + (slips.a - Vec{{0, 1.5}}).norm(), 1e-14);
  const std::vector<ContactPoint> slides{{.normal = 0, .tangent = 1, .kind = Tangent::sliding, .ratio = {-0.4, 0}}};
  const Exact known = exact_from(slides, foot.A, Vec{{-10, 9}}, none, parts);
  ASSERT_TRUE(known.found);
  EXPECT_LE((known.F - Vec{{5, -2}}).norm() + (known.a - Vec{{0, 3}}).norm(), 1e-14);
}

// What its friction held moves with it.
TEST(ExactModes, OfAFootThatPartsHaveNoFriction) {
  const Foot foot;
  const Exact parts = exact_from(foot.points, foot.A, Vec{{1, 0.3}}, Vec{{5, -0.1}}, Vec::Zero(2));
  ASSERT_TRUE(parts.found);
  EXPECT_EQ(parts.F, Vec::Zero(2));
  EXPECT_EQ(parts.a, (Vec{{1, 0.3}}));
}

TEST(ExactModes, OfARoughFootThatPartsAsItSlipsHaveNoFriction) {
  std::vector<ContactPoint> rough = Foot().points;
  rough[0].coefficient = 1;  // friction would accelerate it more than the pull that parts it
  const Exact parts = exact_from(rough, Foot().A, Vec{{1, 0.3}}, Vec{{5, -5}}, Vec{{0, 3}});
  ASSERT_TRUE(parts.found);
  EXPECT_EQ(parts.F, Vec::Zero(2));
  EXPECT_EQ(parts.a, (Vec{{1, 0.3}}));
}

TEST(ExactModes, KeepAContactClosedThatPullsByRoundOff) {
  const Exact exact = exact_near(normals(2), Mat::Identity(2, 2), Vec{{-10, 1e-12}}, Vec{{10, 0}});
  ASSERT_TRUE(exact.found);
  EXPECT_EQ(exact.a, Vec::Zero(2));
  const Exact parts = exact_near(normals(2), Mat::Identity(2, 2), Vec{{-10, 3e-11}}, Vec{{10, 0}});
  ASSERT_TRUE(parts.found);
  EXPECT_EQ(parts.a, (Vec{{0, 3e-11}}));
}

// c N = 0.5. A force that exceeds it by `beyond` would accelerate the foot by 4 times as much. `light`: a body that a
// contact holds with a force of 2 N.
Exact pushed_foot(double beyond, bool light) {
  std::vector<ContactPoint> points{{.tangent = 0, .kind = Tangent::resting, .coefficient = 0.5, .given = 1}};
  const double push = 4 * (0.5 + beyond);
  if (!light) return exact_near(points, Mat{{4}}, Vec{{-push}}, Vec{{0.5}});
  points.push_back({.normal = 1});
  return exact_near(points, Mat{{4, 0}, {0, 1e5}}, Vec{{-push, -2e5}}, Vec{{0.5, 2}});
}

// To 1e-12 of the terms of its acceleration, 2 + 2; beside a light body to that of ten times of what the largest force
// would do, because forces that are shared are as exact as the largest of them; but not to that of the light body's.
TEST(ExactModes, HoldAFootAtItsBoundToTheRoundOffOfItsOwnAccelerations) {
  for (const auto& [light, round_off] : {std::pair(false, 4e-12), std::pair(true, 80e-12)}) {
    SCOPED_TRACE(light);
    const Exact holds = pushed_foot(0.95 * round_off / 4, light), slips = pushed_foot(1.05 * round_off / 4, light);
    ASSERT_TRUE(holds.found && slips.found);
    EXPECT_EQ(holds.a[0], 0);
    EXPECT_GT(holds.F[0], 0.5);
    EXPECT_EQ(slips.F[0], 0.5);
    EXPECT_NEAR(slips.a[0], -1.05 * round_off, 1e-15);
  }
}

// The round-off of shares is at most that of all accelerations: a heavy body's force is large.
TEST(ExactModes, HoldAFootBesideAHeavyBodyToTheRoundOffOfTheirAccelerations) {
  const std::vector<ContactPoint> points{{.tangent = 0, .kind = Tangent::resting, .coefficient = 0.5, .given = 1},
                                         {.normal = 1}};
  const Mat A{{4, 0}, {0, 1e-3}};
  const auto slip = [&](double beyond) {
    const Exact exact = exact_near(points, A, Vec{{-4 * (0.5 + beyond), -1}}, Vec{{0.5, 1000}});
    EXPECT_TRUE(exact.found);
    return exact.a[0];
  };
  EXPECT_EQ(slip(0.95e-12), 0);
  EXPECT_NEAR(slip(1.05e-12), -4.2e-12, 1e-15);
}

// Painleve's rod at the bound of its friction: sticking it would need 2 + e with N = 1, and c = 2 allows only 2; but a
// slip would have the friction 2 N in its own direction. It holds if e is round-off of a light body beside it.
TEST(ExactModes, AreTheBestToTheRoundOffOfTheLargestAccelerationsWhereNoneAreBetter) {
  const std::vector<ContactPoint> points{{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 2},
                                         {.normal = 2}};
  const Mat A{{1, -1.5, 0}, {-1.5, 4, 0}, {0, 0, 1e5}};
  const auto rod = [&](double e) {
    const Vec F{{1, 2 + e, 1}};
    return exact_from(points, A, -A * F, F, Vec::Zero(3));
  };
  for (const double e : {1e-9, 4e-8}) {
    const Exact holds = rod(e);
    ASSERT_TRUE(holds.found) << e;
    EXPECT_LE((holds.F - Vec{{1, 2 + e, 1}}).norm(), 1e-14);
    EXPECT_LE(holds.a.norm(), 1e-14);
  }
  // Begun with the slip, that is found first: it needs N = (2 + 1.5 e) / 2.
  const double e = 4e-8;
  const Exact slips = exact_from(points, A, -A * Vec{{1, 2 + e, 1}}, Vec{{1, 2, 1}}, Vec{{0, 1, 0}});
  ASSERT_TRUE(slips.found);
  EXPECT_LE((slips.F - Vec{{1 + 0.75 * e, 2 + 1.5 * e, 1}}).norm(), 1e-14);
  EXPECT_NEAR(slips.a[1], 0.875 * e, 1e-14);
  EXPECT_FALSE(rod(4e-7).found);  // the slip's 0.875 e, too, is more than 1e-12 of 2e5
}

// Two rows of length 4 at an angle of 2.5e-7, so small that the second follows from the first. Their body also moves
// across, with 1, so that they differ by 1e-6. `row`: of one more contact of the body, along and across; `own`: what
// its other side does.
struct NearlyParallel {
  static constexpr double differ = 4 * 2.5e-7;
  explicit NearlyParallel(const Eigen::RowVector2d& row, double own = 0) {
    Mat G(3, 2);
    G << 4, 0, 4, 4 * 2.5e-7, row;
    const Vec b = G * Vec{{-10, 1}} + Vec{{0, 0, own}};
    const Exact exact = exact_near(normals(3), G * G.transpose(), b, Vec::Ones(3));
    EXPECT_TRUE(exact.found);
    EXPECT_LE((exact.F - Vec{{1.25, 1.25, 0}}).norm(), 1e-6);
    a = exact.a;
  }
  Vec a;
};

// If a contact moves so fast that the angle explains it, by its rate over its length.
TEST(ExactModes, HaveNoAccelerationAlongARowThatFollowsFromOthersButForAnAngle) {
  const NearlyParallel seen({0, 0.5});  // as 1 across
  EXPECT_EQ(seen.a.head(2), Vec::Zero(2));
  EXPECT_NEAR(seen.a[2], 0.5, 1e-6);
  for (const NearlyParallel& unseen : {NearlyParallel({3, 1}), NearlyParallel({0, 0}, 0.1)}) {  // as 1/3.16 across; 0
    EXPECT_LE(std::abs(unseen.a[0]), 1e-13);
    EXPECT_NEAR(unseen.a[1], NearlyParallel::differ, 1e-11);
  }
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
