// Impacts at an event, and the end of motions that are too brief to follow, without the time loop.
#include "simulate/settling/contact_impacts.hpp"

#include <limits>

#include "simulate/settling/contact_events.hpp"
#include "simulate/settling/present_contacts.hpp"
#include "simulate/settling/rocking.hpp"

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using complementarity::LcpOutcome;
using Kind = simulate::ContactEvent::Kind;

TEST(ContactImpacts, ReboundAndTellWhatTheyLost) {
  PointAtEvent point("[0, -10]", "[0, -3]");
  simulate::ContactImpacts impacts(point.scene, point.at);
  simulate::ContactChanges changes;
  changes.struck = {0};
  impacts.find_touching(changes);
  ASSERT_EQ(point.at.touching.size(), 1u);
  ASSERT_EQ(impacts.strike(point.state, changes).outcome, LcpOutcome::solved);
  EXPECT_NEAR(point.state.v[1], 1.5, 1e-12);
  EXPECT_NEAR(point.at.touching[0].impulse, 2 * 4.5, 1e-12);
  ASSERT_EQ(impacts.losses().size(), 1u);
  EXPECT_NEAR(impacts.losses()[0].energy, 9 - 2.25, 1e-12);
  EXPECT_NEAR(impacts.lost_elsewhere(), 0, 1e-12);
}

TEST(ContactImpacts, OfWhatDoesNotTouchAreNone) {
  PointAtEvent point("[0, -10]", "[0, -3]");
  point.state.q[1] = 0.1;
  point.system.move_to(0, point.state.q, point.state.v);
  simulate::ContactImpacts impacts(point.scene, point.at);
  impacts.find_touching({});
  EXPECT_TRUE(point.at.touching.empty());
}

TEST(Rocking, EndsABriefRateAndTellsItsEnergy) {
  PointAtEvent point("[0, -10]", "[0.5, 1e-4]");
  point.at.touching[0].after = 1e-4;
  point.at.touching[0].slip_after = {0.5, 0};
  const double taken = simulate::Rocking(point.scene, point.at.touching).end(point.state, {{true}, {false}});
  EXPECT_NEAR(taken, 1e-8, 1e-20);
  EXPECT_NEAR(point.state.v[1], 0, 1e-18);
  EXPECT_DOUBLE_EQ(point.state.v[0], 0.5);  // its slip goes on
  EXPECT_EQ(point.at.touching[0].after, 0);
}

TEST(EventsOfContacts, NameWhoClosesAndWhoLifts) {
  PointAtEvent point("[0, -10]");
  std::vector<simulate::ContactEvent> events;
  const auto kinds = [&](const std::vector<int>& candidates) {
    events.clear();
    simulate::append_normal_events(point.at, 0, candidates, events);
    std::vector<Kind> all;
    for (const simulate::ContactEvent& event : events) all.push_back(event.kind);
    return all;
  };
  EXPECT_TRUE(kinds({0}).empty());  // it was open and stays open, without an impulse
  point.at.touching[0].impulse = 1;
  EXPECT_EQ(kinds({0}), std::vector{Kind::lift});
  EXPECT_TRUE(kinds({}).empty());
  point.mode().closed = true;
  EXPECT_EQ(kinds({0}), std::vector{Kind::close});
}

TEST(PresentContacts, LimitStepsOnlyWhereTheyRub) {
  PointAtEvent point("[0, -10]");
  EXPECT_FALSE(simulate::any_closed(point.system));
  model::Modes closed = point.at.modes;
  closed.contacts[0].closed = true;
  point.system.set_modes(closed);
  EXPECT_TRUE(simulate::any_closed(point.system));
  EXPECT_TRUE(simulate::any_rigid_closed(point.system));
  EXPECT_EQ(simulate::longest_step_in_contact(point.system, point.state), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace trammel::test
