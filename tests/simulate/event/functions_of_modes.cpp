#include "simulate/event/functions_of_modes.hpp"

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

using simulate::EventFunction;
using Kind = EventFunction::Kind;
using Friction = model::ContactMode::Friction;

std::vector<Kind> kinds(bool closed, Friction friction) {
  PointAtEvent point("[0, -10]");
  model::Modes modes;
  modes.contacts = {{.closed = closed, .friction = friction}};
  modes.contacts[0].direction[0] = 1;
  point.system.set_modes(modes);
  std::vector<Kind> found;
  for (const EventFunction& each : simulate::functions_of_modes(point.system, point.scale)) found.push_back(each.kind);
  return found;
}

TEST(FunctionsOfModes, AreThoseWhoseZeroEndsTheMode) {
  EXPECT_EQ(kinds(false, Friction::none), (std::vector{Kind::approach}));
  EXPECT_EQ(kinds(true, Friction::none), (std::vector{Kind::press}));
  EXPECT_EQ(kinds(true, Friction::stick), (std::vector{Kind::press, Kind::hold}));
  EXPECT_EQ(kinds(true, Friction::slide), (std::vector{Kind::press, Kind::slide}));
}

}  // namespace
}  // namespace trammel::test
