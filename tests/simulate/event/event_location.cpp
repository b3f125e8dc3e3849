#include "simulate/event/event_location.hpp"

#include <cmath>

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using simulate::EventLocation;

// The point falls from 0.2 m: it touches the floor after 0.2 s.
struct Fall : PointAtEvent {
  Fall() : PointAtEvent("[0, -10]") {
    state.q[1] = 0.2;
    state.a = Vec::Zero(2), state.a[1] = -10;
    system.move_to(state.t, state.q, state.v);
    scale.take_all(system);
    setup.integrator->restart(system, state);
    location.restart(state);
  }
  EventLocation::Found try_step(double length) {
    h = length;
    EXPECT_TRUE(setup.integrator->step(system, state, h, next));
    return location.examine(state, h, next, EventLocation::Steps::fixed);
  }
  simulate::ContactModes modes{system, scale, setup.settings};
  EventLocation location{system, *setup.integrator, modes, scale};
  State next;
  double h = 0;
};

TEST(EventLocation, ShortensAStepToItsFirstEvent) {
  Fall fall;
  ASSERT_EQ(fall.try_step(0.3), EventLocation::Found::event);
  EXPECT_NEAR(fall.h, 0.2, 4e-16);  // four units in the last place
  EXPECT_EQ(fall.next.t, fall.h);
  EXPECT_NEAR(fall.next.q[1], 0, 1e-15);
  EXPECT_EQ(fall.location.changes().struck, std::vector<int>{0});
}

TEST(EventLocation, LeavesAStepWithoutAnEventAsItIs) {
  Fall fall;
  ASSERT_EQ(fall.try_step(0.15), EventLocation::Found::nothing);
  EXPECT_EQ(fall.h, 0.15);
  EXPECT_EQ(fall.location.steps_tried(), 0);
  EXPECT_TRUE(fall.location.changes().empty());
}

TEST(EventLocation, FindsTheSameAfterATrialThatWasNotAccepted) {
  Fall once, again;
  again.try_step(0.15);
  again.try_step(0.5);
  once.try_step(0.3), again.try_step(0.3);
  EXPECT_EQ(once.h, again.h);
  EXPECT_EQ(once.next.q, again.next.q);
}

TEST(EventLocation, TellsAGapThatIsNotFinite) {
  Fall fall;
  fall.h = 0.1;
  fall.next = fall.state;
  fall.next.q[1] = std::nan("");
  EXPECT_EQ(fall.location.examine(fall.state, fall.h, fall.next, EventLocation::Steps::fixed),
            EventLocation::Found::not_finite);
}

}  // namespace
}  // namespace trammel::test
