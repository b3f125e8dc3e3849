// The energetic law alone, on random bodies that strike: what it promises of energy, friction and restitution.
#include <gtest/gtest.h>

#include "struck_bodies.hpp"

namespace trammel::test {
namespace {

// Of the kinetic energy before. Steps are followed to 2e-13 and events to 1e-13 of the largest rate
// (spring_impact.hpp); an impact of 1,000 phases between bodies of ratios 1e4 leaves ten times as much.
constexpr double round_off = 1e-11;

struct Books {
  double change, lost;  // [J] of the kinetic energy; of all contacts
};

Books books(const StruckBodies& s, const simulate::SpringImpact& impact) {
  return {0.5 * impact.impulses().dot(s.u + impact.rates()), impact.lost_normal().sum() + impact.lost_friction().sum()};
}

simulate::SpringImpact struck(const StruckBodies& s, int i) {
  simulate::SpringImpact impact(s.contacts, s.A, s.u, s.tangents);
  EXPECT_EQ(impact.run().outcome, complementarity::LcpOutcome::solved) << i;
  return impact;
}

// How far friction impulses are outside of their cones, in parts of them.
double outside(const StruckBodies& s, const Vec& P) {
  double most = 0;
  for (const simulate::SpringContact& c : s.contacts) {
    if (c.tangent < 0) continue;
    const double bound = c.mu_0 * P[c.normal], T = P.segment(c.tangent, s.tangents).norm();
    most = std::max(most, (T - bound) / (bound + 1e-3 * P.norm()));
  }
  return most;
}

Kinds kinds_of(int i) {
  Kinds kinds;
  kinds.spatial = i % 2 == 1, kinds.friction = i % 5 != 0, kinds.joints = i % 3 == 0, kinds.dependent = i % 7 == 0;
  kinds.contacts = 1 + i % (kinds.spatial ? 4 : 6);
  kinds.mass_ratio = i % 4 == 0 ? 1e4 : 10;
  return kinds;
}

TEST(EnergeticLaw, NeverGainsEnergyInRandomImpactsAndTheBooksOfItsLossesBalance) {
  std::mt19937 random(1);
  int cut_short = 0;
  for (int i = 0; i < 2000; ++i) {
    const StruckBodies s = RandomStrike(random, kinds_of(i)).make();
    const simulate::SpringImpact impact = struck(s, i);
    cut_short += impact.cut_short();
    const auto [change, lost] = books(s, impact);
    EXPECT_LE(change, 1e-14 * s.kinetic) << i;  // round-off of this sum
    EXPECT_NEAR(change, -lost, round_off * s.kinetic) << i;
    // Shares of contacts that stick together are found to 1e-9 of their bounds.
    EXPECT_LE(outside(s, impact.admissible_impulses()), 1e-9) << i;
    EXPECT_GE(impact.admissible_impulses()(0), 0) << i;
    // An end without restitution takes energy in all, though friction may take at one contact what it gives at another.
    if (!impact.cut_short()) {
      EXPECT_GE(impact.lost_friction().minCoeff(), -round_off * s.kinetic) << i;
    }
    const Vec u = impact.rates();
    for (const simulate::SpringContact& c : s.contacts)
      EXPECT_GE(u[c.normal], -1e-9 * s.u.lpNorm<Eigen::Infinity>()) << i;  // dependent contacts give way by as much
  }
  EXPECT_LE(cut_short, 20);  // bodies that shuttle between others for ever are rare
}

TEST(EnergeticLaw, GivesBackOfEachContactsCompressionThePartThatItAsks) {
  std::mt19937 random(2);
  int judged = 0;
  for (int i = 0; i < 500; ++i) {
    const StruckBodies s = RandomStrike(random, kinds_of(i)).make();
    const simulate::SpringImpact impact = struck(s, i);
    if (impact.taken_at_end() > 0) continue;  // springs that stay wedged give nothing back
    ++judged;
    for (std::size_t k = 0; k < s.contacts.size(); ++k) {
      const double e = s.contacts[k].e, compressed = impact.compressed()[Eigen::Index(k)];
      EXPECT_NEAR(impact.lost_normal()[Eigen::Index(k)], (1 - e * e) * compressed, round_off * s.kinetic) << i;
    }
  }
  EXPECT_GT(judged, 350);
}

// After each event some function of the events is 0 (the rate where a compression has ended, that of a contact that has
// been left) and grows, while another one falls to the next event.
TEST(EnergeticLaw, LocatesEachEventInFewTrialsThoughOtherFunctionsBeginAtZero) {
  std::mt19937 random(4);
  int events = 0, trials = 0;
  for (int i = 0; i < 60; ++i) {
    Kinds kinds = kinds_of(i);
    kinds.contacts = kinds.spatial ? 4 : 8;
    const StruckBodies s = RandomStrike(random, kinds).make();
    const simulate::SpringImpact impact = struck(s, i);
    events += impact.events(), trials += impact.trials();
  }
  EXPECT_GT(events, 1000);
  EXPECT_LT(trials, 8 * events) << events;
}

// Without friction the normal's work is the change of energy, by Newton's u+ = -e u-; and e^2 of compression comes
// back.
TEST(EnergeticLaw, IsNewtonsLawOfOneContactWithoutFriction) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    Kinds kinds = kinds_of(i);
    kinds.contacts = 1, kinds.friction = false;
    const StruckBodies s = RandomStrike(random, kinds).make();
    const simulate::SpringImpact impact = struck(s, i);
    const double e = s.contacts[0].e, expected = s.u[0] < 0 ? -e * s.u[0] : s.u[0];
    EXPECT_NEAR(impact.rates()[0], expected, 1e-12 * std::abs(s.u[0])) << i;
  }
}

}  // namespace
}  // namespace trammel::test
