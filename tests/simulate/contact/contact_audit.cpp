// What contacts cannot do is told, however much larger the forces of others are.
#include <gmock/gmock.h>

#include "simulate/contact/contact_audit.hpp"
#include "simulate/start/setup.hpp"
#include "support/made.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A ball on a floor under a load, and a heavy block on the same floor; or on the block, if it lies on it.
std::string beside(double mass, double lift, double push, bool on_block) {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 1e-3, "position": [0, 0]}},
             "block": {{"type": "rigid_body", "mass": {0:.17g}, "inertia": {0:.17g}, "position": [0, 0]}}}},
  "forces": {{"load": {{"type": "load", "on": "ball.point", "force": {{"x": {2:.17g}, "y": {1:.17g}}}}}}},
  "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "block.com"], "axis": [0, 1]}}}},
  "contacts": {{"ball": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 0.5, "kinetic": 0.5}},
                        "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]{3}}}}}]}},
               "block": {{"type": "constraint_method",
                         "between": ["block.com", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": 1}}, "record": {{"every": 1, "observe": {{"y": "ball.point.y"}}}}}})",
                     mass, lift, push, on_block ? R"(, "on": "block.com")" : "");
}

// With all contacts closed, and the ball held by friction.
std::vector<std::string> told(const std::string& scene) {
  simulate::Setup setup = simulate::set_up(scene::Scene::parse(scene, "test.json"), registry());
  model::AssembledSystem system(setup.model);
  model::Modes modes{.contacts = std::vector<model::ContactMode>(2), .shared = {}};
  for (model::ContactMode& mode : modes.contacts) mode.closed = true;
  State state = setup.initial;
  system.set_modes(modes);
  system.move_to(state.t, state.q, state.v);
  modes.contacts[0].friction = model::ContactMode::Friction::stick;
  system.anchor(0, modes.contacts[0]);
  system.set_modes(modes);
  system.move_to(state.t, state.q, state.v);
  system.accelerate({}, state.a, state.lambda);
  simulate::ContactScale scale(*setup.model);
  scale.take_all(system);
  simulate::ContactAudit audit;
  audit.look(system, state, scale);
  return audit.warnings(*setup.model, simulate::Ledger(system, *setup.integrator));
}

// Its weight is 0.01 N.
TEST(ContactAudit, TellsAPullAndAFrictionBeyondItsBoundBesideAnyForceElsewhere) {
  for (const bool on_block : {false, true})
    for (const double mass : {1e-3, 1.0, 1e3, 1e6, 1e9}) {
      EXPECT_THAT(told(beside(mass, 0.005, 0.002, on_block)), IsEmpty()) << mass;
      EXPECT_THAT(told(beside(mass, 0.012, 0, on_block)), ElementsAre(HasSubstr("contacts.ball pulled with 0.002 N")))
          << mass;
      EXPECT_THAT(told(beside(mass, 0.005, 0.003, on_block)),
                  ElementsAre(HasSubstr("the friction of contacts.ball was 0.0005 N beyond its bound")))
          << mass;
    }
}

// A load that takes the weight off leaves no force but what 1 N of round-off leaves of 0.
TEST(ContactAudit, DoesNotTellRoundOff) {
  for (const bool on_block : {false, true})
    for (const double part : {-1e-15, 0.0, 1e-15})
      EXPECT_THAT(told(beside(1, 0.01 * (1 + part), 0, on_block)), IsEmpty()) << part;
}

}  // namespace
}  // namespace trammel::test
