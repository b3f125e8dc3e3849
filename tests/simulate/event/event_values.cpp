#include "simulate/event/event_values.hpp"

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using Kind = EventFunction::Kind;
using Friction = model::ContactMode::Friction;

struct Values : PointAtEvent {
  using PointAtEvent::PointAtEvent;
  void close(Friction friction) {
    model::Modes closed;
    closed.contacts = {{.closed = true, .friction = friction}};
    closed.contacts[0].direction[0] = 1;
    system.set_modes(closed);
    system.move_to(state.t, state.q, state.v);
    system.accelerate({}, state.a, state.lambda);
  }
  simulate::ValueAndSlope of(EventFunction function) {
    values.move_to(state);
    return values.at(function, state);
  }
  simulate::EventValues values{system, *setup.integrator, scale};
};

TEST(EventValues, OfAnOpenContactAreItsGapAndGapRate) {
  Values point("[0, -10]", "[3, -2]");
  point.state.q[1] = 0.5;
  const auto gap = point.of({.contact = 0, .kind = Kind::approach});
  EXPECT_NEAR(gap.f, 0.5, 1e-15);
  EXPECT_NEAR(gap.slope, -2, 1e-15);
}

TEST(EventValues, OfAContactThatSticksAreItsForceAndWhatFrictionCouldMore) {
  Values point("[4, -10]");
  point.close(Friction::stick);
  EXPECT_NEAR(point.of({.contact = 0, .kind = Kind::press}).f, 20, 1e-12);  // 2 kg
  EXPECT_NEAR(point.of({.contact = 0, .kind = Kind::hold}).f, 0.5 * 20 - 2 * 4, 1e-12);
}

TEST(EventValues, OfASlidingContactAreItsSlipAndTheRateOfIt) {
  Values point("[0, -10]", "[3, 0]");
  point.close(Friction::slide);
  const auto slip = point.of({.contact = 0, .kind = Kind::slide});
  EXPECT_NEAR(slip.f, 3, 1e-15);
  EXPECT_NEAR(slip.slope, -0.4 * 10, 1e-12);  // mu g
}

// Runge-Kutta methods satisfy neither position nor velocity rows.
TEST(EventValues, TakeTheMultipliersOfAMethodThatHoldsNoRows) {
  Values point("[0, -10]");
  point.close(Friction::none);
  point.state.lambda *= 2;
  EXPECT_NEAR(point.of({.contact = 0, .kind = Kind::press}).f, 40, 1e-12);
}

TEST(EventValues, FindTheSlopeOfAForceByADifference) {
  const char* push = R"({"push": {"type": "load", "on": "ball.point", "force": {"y": "=-5*t"}}})";  // -5 N/s
  const simulate::Setup setup =
      simulate::set_up(scene::Scene::parse(PointAtEvent::text, "test.json", {{"forces", push}}), registry());
  model::AssembledSystem system(setup.model);
  const simulate::ContactScale scale(*setup.model);
  simulate::EventValues values(system, *setup.integrator, scale);
  model::Modes closed;
  closed.contacts = {{.closed = true}};
  system.set_modes(closed);
  State state = setup.initial;
  system.move_to(state.t, state.q, state.v);
  system.accelerate({}, state.a, state.lambda);
  EventFunction press{.contact = 0, .kind = Kind::press};
  for (const double dt : {1e-3, -1e-3})
    EXPECT_NEAR(values.force_slopes({&press}, state, dt).front(), 5, 1e-9);  // round-off of 20 N over dt
}

}  // namespace
}  // namespace trammel::test
