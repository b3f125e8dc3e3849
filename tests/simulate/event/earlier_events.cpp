#include "simulate/event/earlier_events.hpp"

#include <gtest/gtest.h>

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using simulate::LastChange;
using Kind = EventFunction::Kind;

// What `now` has learnt from `before`, which watched the same.
EventFunction learnt(const EventFunction& now, const EventFunction& before, LastChange change = {}) {
  const PointAtEvent point("[0, -10]");
  std::vector<EventFunction> functions{now};
  change.before = simulate::by_what_they_watch({before});
  simulate::keep_what_was_learnt(functions, change, point.scale);
  return functions[0];
}
EventFunction force(double f, double noise = 0, bool reported = false) {
  return {.contact = 0, .kind = Kind::press, .noise = noise, .reported = reported, .now = {f, 0}};
}

TEST(EarlierEvent, OfTheSameFunctionIsOneAgainWhenSeveralTimesAsMuchIsMissing) {
  EXPECT_EQ(learnt(force(0), force(0, 1e-3, true)).noise, 4e-3);
  EXPECT_EQ(learnt(force(-1), force(0, 1e-3)).noise, 2);
}

TEST(EarlierEvent, OfAnotherFunctionLeavesItsNoise) {
  EXPECT_EQ(learnt(force(5), force(4, 1e-3)).noise, 1e-3);
}

TEST(EarlierEvent, OfAnotherContactTeachesNothing) {
  EventFunction other = force(0, 1e-3, true);
  other.contact = 1;
  EXPECT_EQ(learnt(force(0), other).noise, 0);
}

TEST(EarlierEvent, OfAnIdleContactIsThatOfItsForce) {
  EventFunction idle = force(0);
  idle.kind = Kind::idle;
  EXPECT_EQ(learnt(idle, force(0, 1e-3, true)).noise, 4e-3);
}

TEST(EarlierEvent, IsForgottenByAGapThatRebounds) {
  EventFunction rebounds{.contact = 0, .kind = Kind::approach, .noise = 1e-12, .now = {0, 1}}, before = rebounds;
  before.noise = 1, before.reported = true;
  EXPECT_EQ(learnt(rebounds, before).noise, 1e-12);
}

// A spare load that was lost, and is that of other springs now, is a new one, unless it was lost a moment ago.
TEST(EarlierEvent, OfASpareLoadIsANewOneByOtherSprings) {
  EventFunction spare{.contact = 0, .kind = Kind::unload, .group = 0, .bound = 1}, before = spare;
  before.noise = 1e-3, before.reported = true;
  EXPECT_EQ(learnt(spare, before, {.other_springs = true}).noise, 1e-3);
  EXPECT_EQ(learnt(spare, before, {.other_springs = false}).noise, 4e-3);
  EXPECT_EQ(learnt(spare, before, {.other_springs = true, .at_once = true}).noise, 4e-3);
}

TEST(EarlierEvent, OfASlipThatStalledMakesItMorePatient) {
  EventFunction slip{.contact = 0, .kind = Kind::slide, .now = {1e-9, 0}}, before = slip;
  before.undirected.stalled = true;
  EXPECT_EQ(learnt(slip, before).undirected.patience, 4 * before.undirected.patience);
}

TEST(SideOfALoad, IsThePresentOneOrTheOtherAfterItPassedZero) {
  const auto side = [](double f, const LastChange& change) {
    std::vector<EventFunction> loads{{.contact = 0, .kind = Kind::load, .bearing = 0, .now = {f, 0}}};
    simulate::choose_sides(loads, change);
    EXPECT_EQ(loads[0].now.f, loads[0].side * f);
    return loads[0].side;
  };
  EXPECT_EQ(side(2, {}), 1);
  EXPECT_EQ(side(-2, {}), -1);
  const EventFunction passed{.contact = 0, .kind = Kind::load, .bearing = 0, .side = -1, .reported = true};
  EXPECT_EQ(side(-1e-15, {.before = simulate::by_what_they_watch({passed})}), 1);
}

TEST(SameModes, DifferByContactFrictionAndSense) {
  using Friction = model::ContactMode::Friction;
  model::ContactMode slides{.closed = true, .friction = Friction::slide};
  slides.direction[0] = 1;
  model::ContactMode turned = slides, back = slides, sticks = slides, open = slides;
  turned.direction[0] = 0.6;
  back.direction[0] = -1;
  sticks.friction = Friction::stick;
  open.closed = false;
  EXPECT_TRUE(simulate::same_modes({slides}, {turned}));
  for (const model::ContactMode& other : {back, sticks, open}) EXPECT_FALSE(simulate::same_modes({slides}, {other}));
  EXPECT_FALSE(simulate::same_modes({slides}, {slides, slides}));
}

}  // namespace
}  // namespace trammel::test
