// The search of all modes and its relaxations by themselves: the cascade of contact_forces.hpp needs them rarely.
#include "complementarity/mode_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "complementarity/mode_relaxation.hpp"
#include "complementarity/programs/friction_cone.hpp"
#include "every_mode.hpp"
#include "random_problems.hpp"

namespace trammel::complementarity {
namespace {

using Kind = DecidedMode::Kind;
using Verdict = RelaxedForces::Verdict;
using Tangent = ContactPoint::Tangent;
using std::numbers::pi;

constexpr double mu = 0.5;

// 2 N_dd = 10 along the normal, so N = 5 where the contact stays closed: it holds T up to 2.5, A_tt = 3.
struct OneContact {
  std::vector<ContactPoint> points;
  Mat A;
  Vec b;

  OneContact(const ContactPoint& p, const Vec& pushed_along)
      : points{p}, A(Mat::Identity(1 + pushed_along.size(), 1 + pushed_along.size()) * 3), b(1 + pushed_along.size()) {
    A(0, 0) = 2;
    b << -10, pushed_along;
  }
  RelaxedForces in(const DecidedMode& mode) const { return relaxed_forces(points, A, b, {mode}); }
};

ContactPoint planar() {
  return {.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = mu};
}
ContactPoint spatial() {
  return {.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = mu};
}

// To the round-off of a least squares problem whose numbers are of the order of 1.
void expect_forces(const RelaxedForces& found, const Vec& F, const Vec& a) {
  ASSERT_EQ(found.verdict, Verdict::found);
  EXPECT_LE((found.F - F).norm(), 1e-13 * (1 + F.norm()));
  EXPECT_LE((found.a - a).norm(), 1e-13 * (1 + F.norm()));
}

TEST(ModeRelaxation, OfADecidedContactInThePlaneIsExact) {
  const OneContact held(planar(), Vec{{6}}), slips(planar(), Vec{{9}});
  expect_forces(held.in({Kind::sticking}), Vec{{5, -2}}, Vec{{0, 0}});
  EXPECT_EQ(slips.in({Kind::sticking}).verdict, Verdict::none);
  expect_forces(slips.in({Kind::sliding, pi, pi}), Vec{{5, -2.5}}, Vec{{0, 1.5}});
  EXPECT_EQ(slips.in({Kind::sliding, 0, 0}).verdict, Verdict::none);
  EXPECT_EQ(held.in({Kind::sliding, pi, pi}).verdict, Verdict::none);
  for (const OneContact& contact : {held, slips}) {
    EXPECT_EQ(contact.in({Kind::open}).verdict, Verdict::none);
    EXPECT_EQ(contact.in({Kind::undecided}).verdict, Verdict::found);
  }
  OneContact parts(planar(), Vec{{9}});
  parts.b[0] = 1;
  expect_forces(parts.in({Kind::open}), Vec{{0, 0}}, Vec{{1, 9}});
  EXPECT_EQ(parts.in({Kind::sticking}).verdict, Verdict::none);
  EXPECT_EQ(parts.in({Kind::sliding, pi, pi}).verdict, Verdict::none);
}

TEST(ModeRelaxation, OfAContactWithoutFrictionPressesOrParts) {
  const Mat A{{2}};
  const std::vector<ContactPoint> point{{.normal = 0}};
  expect_forces(relaxed_forces(point, A, Vec{{-10}}, {{Kind::pressing}}), Vec{{5}}, Vec{{0}});
  EXPECT_EQ(relaxed_forces(point, A, Vec{{10}}, {{Kind::pressing}}).verdict, Verdict::none);
  expect_forces(relaxed_forces(point, A, Vec{{10}}, {{Kind::open}}), Vec{{0}}, Vec{{10}});
}

// Friction p N of a known slip pushes the contact closed by 1 N for each 2 N: a_n = (2 - 1) N - 10.
TEST(ModeRelaxation, OfAKnownSlipHasItsFrictionInTheNormalForce) {
  const Mat A{{2, 1}, {1, 3}};
  ContactPoint slides{.normal = 0, .tangent = 1, .kind = Tangent::sliding};
  slides.ratio[0] = -1;
  expect_forces(relaxed_forces({slides}, A, Vec{{-10, 0}}, {{Kind::pressing}}), Vec{{10, -10}}, Vec{{0, -20}});
  slides.ratio[0] = -2;  // Painleve's critical coefficient: a_n = 0 N - 10
  EXPECT_EQ(relaxed_forces({slides}, A, Vec{{-10, 0}}, {{Kind::pressing}}).verdict, Verdict::none);
}

TEST(ModeRelaxation, UnderAGivenForceHoldsUpToItsBound) {
  const Mat A{{3}};
  const std::vector<ContactPoint> bearing{{.tangent = 0, .kind = Tangent::resting, .coefficient = mu, .given = 4}};
  expect_forces(relaxed_forces(bearing, A, Vec{{5.9}}, {{Kind::sticking}}), Vec{{-5.9 / 3}}, Vec{{0}});
  EXPECT_EQ(relaxed_forces(bearing, A, Vec{{6.1}}, {{Kind::sticking}}).verdict, Verdict::none);
  expect_forces(relaxed_forces(bearing, A, Vec{{9}}, {{Kind::sliding, pi, pi}}), Vec{{-2}}, Vec{{3}});
  expect_forces(relaxed_forces(bearing, A, Vec{{-9}}, {{Kind::sliding, 0, 0}}), Vec{{2}}, Vec{{-3}});
}

// Its corners are 1 / cos 22.5 degrees = 1.082 from the centre.
TEST(ModeRelaxation, OfAStickingContactInSpaceIsTheOctagonAroundTheDisk) {
  for (int corner = 0; corner < 8; ++corner) {
    const auto holds = [&](double part, double degrees) {
      const double angle = (45 * corner + degrees) * pi / 180;
      const Vec push = -3 * 2.5 * part * Vec{{std::cos(angle), std::sin(angle)}};
      return OneContact(spatial(), push).in({Kind::sticking}).verdict;
    };
    EXPECT_EQ(holds(1.081, 0), Verdict::found) << corner;
    EXPECT_EQ(holds(1.084, 0), Verdict::none) << corner;
    EXPECT_EQ(holds(0.999, 22.5), Verdict::found) << corner;
    EXPECT_EQ(holds(1.001, 22.5), Verdict::none) << corner;
  }
}

// T on the arc between 20 and 50 degrees, or in the triangle around it; a_t against a direction between them.
TEST(ModeRelaxation, OfASlidingContactInSpaceIsTheTriangleAroundTheArc) {
  const DecidedMode between{Kind::sliding, 20 * pi / 180, 50 * pi / 180};
  const auto pushed = [](double size, double degrees) {
    return OneContact(spatial(), -size * Vec{{std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)}});
  };
  for (const double degrees : {20.1, 35.0, 49.9}) EXPECT_EQ(pushed(20, degrees).in(between).verdict, Verdict::found);
  for (const double degrees : {10.0, 60.0, 215.0, 300.0})
    EXPECT_EQ(pushed(20, degrees).in(between).verdict, Verdict::none) << degrees;
  // On the chord, cos 15 degrees from the centre, a push is not yet exceeded by the friction that opposes it.
  EXPECT_EQ(pushed(7.5 * 0.965, 35).in(between).verdict, Verdict::none);
  EXPECT_EQ(pushed(7.5 * 0.967, 35).in(between).verdict, Verdict::found);
}

// A solution is one of the relaxation in its own modes, and of all in which some of them are open to question.
TEST(ModeRelaxation, KeepsEverySolution) {
  std::mt19937 random(71);
  int kept = 0;
  for (int i = 0; i < 400; ++i) {
    const Problem problem = any_planar(random, 1 + i % 5);
    const Answer answer = solve(problem);
    if (answer.outcome != LcpOutcome::solved) continue;
    std::vector<DecidedMode> modes;
    for (const ContactPoint& p : problem.points) {
      if (p.normal >= 0 && answer.F[p.normal] == 0)
        modes.push_back({Kind::open});
      else if (!p.held())
        modes.push_back({Kind::pressing});
      else if (answer.a[p.tangent] == 0)
        modes.push_back({Kind::sticking});
      else
        modes.push_back({Kind::sliding, answer.F[p.tangent] > 0 ? 0 : pi, answer.F[p.tangent] > 0 ? 0 : pi});
    }
    const RelaxedForces found = relaxed_forces(problem.points, problem.A, problem.b, modes);
    EXPECT_NE(found.verdict, Verdict::none) << i;
    if (found.verdict == Verdict::found) {
      ++kept;
      EXPECT_LE(offence(problem, found.F, found.a), 1e-6 * problem.b.lpNorm<Eigen::Infinity>()) << i;
    }
    for (std::size_t k = 0; k < modes.size(); ++k) {
      modes[k] = {};
      EXPECT_NE(relaxed_forces(problem.points, problem.A, problem.b, modes).verdict, Verdict::none) << i;
    }
  }
  EXPECT_GT(kept, 200);
}

LcpOutcome search(const Problem& problem, int most_nodes, Vec& F) {
  return search_modes(problem.points, problem.A, problem.b, most_nodes, [&](const Vec& near) {
    F = near;
    return violation(problem.points, problem.A, problem.b, near) <= largest_violation;
  });
}

TEST(ModeSearch, FindsForcesWhereEnumerationDoesAndOnlyThere) {
  std::mt19937 random(72);
  int without = 0;
  for (int i = 0; i < 600; ++i) {
    RandomKinds kinds;
    kinds.contacts = 1 + i % 4, kinds.velocities = 2 * kinds.contacts;
    kinds.most_friction = i % 2 ? 100 : 3, kinds.resting_only = i % 3 == 0;
    Problem problem = random_planar(random, kinds);
    const double unit = std::pow(10.0, i % 7 * 2 - 6);  // of accelerations and forces
    problem.b *= unit;
    for (ContactPoint& p : problem.points) p.given *= unit;
    Vec F, other;
    const bool exists = exists_in_some_mode(problem, other);
    ASSERT_EQ(search(problem, 20000, F), exists ? LcpOutcome::solved : LcpOutcome::no_solution) << i;
    without += !exists;
  }
  EXPECT_GT(without, 20);
}

// Where nobody asks for a proof, the methods before the search give up instead.
TEST(ModeSearch, IsLeftOutWhereItIsNotAskedFor) {
  std::mt19937 random(74);
  int without = 0;
  for (int i = 0; i < 300; ++i) {
    RandomKinds kinds;
    kinds.contacts = 1 + i % 4, kinds.velocities = 2 * kinds.contacts, kinds.most_friction = 100;
    const Problem problem = random_planar(random, kinds);
    const Answer searched = solve(problem);
    Vec F, a;
    std::vector<double> each;
    const std::vector<double> nothing(problem.points.size(), 0);
    const ContactSolution at_once =
        solve_contacts(problem.points, problem.A, problem.b, F, a, nothing, each, {}, ModeSearch::none);
    without += searched.outcome == LcpOutcome::no_solution && at_once.outcome == LcpOutcome::gave_up;
    if (at_once.outcome != LcpOutcome::solved) continue;
    EXPECT_EQ(F, searched.F) << i;
  }
  EXPECT_GT(without, 20);
}

TEST(ModeSearch, GivesUpIfItsNodesAreUsedUpOrNothingIsAccepted) {
  const Problem problem{{planar()}, Mat{{2, 0}, {0, 3}}, Vec{{-10, 9}}, "a foot that slips"};
  Vec F;
  EXPECT_EQ(search(problem, 0, F), LcpOutcome::gave_up);
  EXPECT_EQ(F.size(), 0);
  EXPECT_EQ(search(problem, 10, F), LcpOutcome::solved);
  const auto never = [](const Vec&) { return false; };
  EXPECT_EQ(search_modes(problem.points, problem.A, problem.b, 1000, never), LcpOutcome::gave_up);
}

// The modes nearest to the relaxed forces are tried first: of the four of a foot, behind the node without any, no more
// than two.
TEST(ModeSearch, TriesTheNearestModesOfAFootFirst) {
  for (const double push : {-9, -6, 0, 6, 9}) {
    const Problem problem{{planar()}, Mat{{2, 0}, {0, 3}}, Vec{{-10, push}}, "a foot"};
    Vec F;
    EXPECT_EQ(search(problem, 3, F), LcpOutcome::solved) << push;
    EXPECT_EQ(search(problem, 0, F), LcpOutcome::gave_up) << push;
  }
}

// Quarters of the circle are halved until less than a degree is left, each time on the side of the slip: eight nodes
// behind the first one. The last forces are within a quarter of that, and 1 / cos^2 of it on the triangle.
TEST(ModeSearch, NarrowsDirectionsOfSlipsInSpaceToADegree) {
  for (double degrees = 3; degrees < 360; degrees += 7) {
    const Eigen::Vector2d e(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180));
    const OneContact slips(spatial(), -9 * e);
    const Vec exact = Vec{{5, 2.5 * e[0], 2.5 * e[1]}};
    double nearest = 1e300;
    search_modes(slips.points, slips.A, slips.b, 10, [&](const Vec& F) {
      nearest = (F - exact).norm();
      return false;
    });
    EXPECT_LE(nearest, 2.5 * pi / 180) << degrees;
  }
}

// In space Newton's method on the cones continues from what is found.
TEST(ModeSearch, FindsForcesOfAFewContactsInSpace) {
  std::mt19937 random(73);
  int solved = 0;
  for (int i = 0; i < 150; ++i) {
    RandomKinds kinds;
    kinds.contacts = 1 + i % 3, kinds.velocities = 3 * kinds.contacts, kinds.most_friction = i % 2 ? 3 : 0.5;
    const Problem problem = random_spatial(random, kinds);
    const LcpOutcome expected = solve(problem).outcome;
    const LcpOutcome outcome = search_modes(problem.points, problem.A, problem.b, 2000, [&](const Vec& near) {
      Vec F = near;
      return solve_cones(problem.points, problem.A, problem.b, F, 1) &&
             violation(problem.points, problem.A, problem.b, F) <= largest_violation;
    });
    EXPECT_EQ(outcome, expected) << i;
    solved += outcome == LcpOutcome::solved;
  }
  EXPECT_GT(solved, 100);
}

}  // namespace
}  // namespace trammel::complementarity
