// The decision of one instant, without the time loop: a point on a floor under a force.
#include "simulate/decision/instant_decision.hpp"

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using complementarity::LcpOutcome;
using Friction = model::ContactMode::Friction;

// The normal force found.
double decide(PointAtEvent& point) {
  simulate::InstantDecision decision(point.scene, point.at);
  EXPECT_EQ(decision.decide(point.state, {}, false).outcome, LcpOutcome::solved);
  return decision.problem().who.at(0).N;
}

TEST(InstantDecision, ClosesAContactThatIsPressed) {
  PointAtEvent point("[0, -10]");
  EXPECT_NEAR(decide(point), 20, 1e-12);
  EXPECT_TRUE(point.mode().closed);
  EXPECT_EQ(point.mode().friction, Friction::stick);
}

TEST(InstantDecision, LeavesOpenWhatAcceleratesApart) {
  PointAtEvent point("[0, 10]");
  EXPECT_EQ(decide(point), 0);
  EXPECT_FALSE(point.mode().closed);
}

TEST(InstantDecision, SticksUpToTheStaticBound) {
  for (const auto& [pull, friction] :
       {std::pair{"[4.9, -10]", Friction::stick}, std::pair{"[5.1, -10]", Friction::slide}}) {
    PointAtEvent point(pull);
    EXPECT_NEAR(decide(point), 20, 1e-12);
    EXPECT_EQ(point.mode().friction, friction) << pull;
  }
}

TEST(InstantDecision, AsksNoneThatIsLeftOut) {
  PointAtEvent point("[0, -10]");
  simulate::InstantDecision decision(point.scene, point.at);
  EXPECT_EQ(decision.decide(point.state, {}, false, {}, 0).outcome, LcpOutcome::solved);
  EXPECT_TRUE(decision.candidates().empty());
  EXPECT_FALSE(point.mode().closed);
}

TEST(Participants, AreThoseThatTouchWithoutARate) {
  PointAtEvent point("[0, -10]");
  const simulate::Participants participants(point.scene, point.at);
  EXPECT_EQ(participants.candidates({}), std::vector<int>{0});
  point.at.touching[0].after = 0.1;
  EXPECT_TRUE(participants.candidates({}).empty());
}

TEST(Participants, DoNotIncludeWhoseForceFellThroughZero) {
  PointAtEvent point("[0, -10]");
  const simulate::Participants participants(point.scene, point.at);
  simulate::ContactChanges changes;
  changes.released = {0};
  EXPECT_TRUE(participants.candidates(changes).empty());
  point.at.touching[0].impulse = 1;  // an impact presses it again
  EXPECT_EQ(participants.candidates(changes), std::vector<int>{0});
}

}  // namespace
}  // namespace trammel::test
