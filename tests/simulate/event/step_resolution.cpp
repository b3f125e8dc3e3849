#include "simulate/event/step_resolution.hpp"

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using Kind = EventFunction::Kind;

// The point in free flight for 0.1 s, from a height of 1 m.
struct Flight : PointAtEvent {
  Flight() : PointAtEvent("[0, -10]", "[0, 1]") {
    state.q[1] = 1;
    state.a = Vec::Zero(2), state.a[1] = -10;
    next = state;
    next.t = h;
    next.v[1] = 1 - 10 * h;
    next.q[1] = 1 + h - 5 * h * h;
  }
  EventFunction gap() const {
    return {.contact = 0, .kind = Kind::approach, .now = {1, 1}, .next = {next.q[1], next.v[1]}};
  }
  bool hides(EventFunction function, double length) {
    std::vector<EventFunction> functions{function};
    return resolution.hides({state, length, next, length}, functions);
  }
  static constexpr double h = 0.1;
  State next;
  simulate::EventValues values{system, *setup.integrator, scale};
  simulate::StepResolution resolution{system, *setup.integrator, values, scale};
};

TEST(StepResolution, ShowsAGapThatIsTheCubicOfItsEnds) {
  Flight flight;
  EXPECT_FALSE(flight.hides(flight.gap(), Flight::h));
}

// As if the floor moved up and down in the step by its own law.
TEST(StepResolution, IsMissingWhereAGapDepartsFromTheCubicOfItsEnds) {
  Flight flight;
  EventFunction gap = flight.gap();
  gap.now.f = gap.next.f = 0.1;
  EXPECT_TRUE(flight.hides(gap, Flight::h));
}

TEST(StepResolution, IsEnoughInStepsFarShorterThanTheLongest) {
  Flight flight;
  EventFunction gap = flight.gap();
  EXPECT_FALSE(flight.hides(gap, 1));
  gap.now.f = gap.next.f = 0.1;
  EXPECT_FALSE(flight.hides(gap, 1e-7));
}

// 30 N, 20 N and what the line through them says: 10 N. A force of 9 N departs little from it, one of 35 N a lot.
TEST(StepResolution, IsMissingWhereAForceDepartsFromItsTangent) {
  Flight flight;
  EventFunction press{.contact = 0, .kind = Kind::press, .now = {20, 0}, .next = {9, 0}, .before = 30};
  EXPECT_FALSE(flight.hides(press, Flight::h));
  press.next.f = 35;
  EXPECT_TRUE(flight.hides(press, Flight::h));
}

TEST(StepResolution, IsMissingWhereASlipIsSteeperThanEverAndCouldHaveTurned) {
  Flight flight;
  EventFunction slip{
      .contact = 0, .kind = Kind::slide, .at_ends = true, .steepest = 1, .now = {0.1, -1}, .next = {0.1, 5}};
  EXPECT_TRUE(flight.hides(slip, Flight::h));
  slip.next.slope = 3;
  EXPECT_FALSE(flight.hides(slip, Flight::h));
}

TEST(LongestStep, IsThatOfSwingsOrAQuarterOfTheTimeInWhichASlipCouldEnd) {
  Flight flight;
  const EventFunction fast{.contact = 0, .kind = Kind::slide, .steepest = 2, .now = {8, 0}};
  const EventFunction holds{.contact = 0, .kind = Kind::hold, .now = {1, 0}};
  EXPECT_EQ(flight.resolution.longest_step({fast}, Flight::h, 0.1), 1);
  EXPECT_EQ(flight.resolution.longest_step({fast}, Flight::h, 3), 3);
  EXPECT_EQ(flight.resolution.longest_step({fast, holds}, Flight::h, 0.1), 0.1);
}

}  // namespace
}  // namespace trammel::test
