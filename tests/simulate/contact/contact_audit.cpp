// Warnings of forces that contacts cannot exert, however much larger the forces of others are.
#include <gmock/gmock.h>

#include "simulate/contact/contact_audit.hpp"
#include "simulate/contact/contact_problem.hpp"
#include "simulate/start/setup.hpp"
#include "simulate/watch/energy_watch.hpp"
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

// Of the forces in these modes.
std::vector<std::string> told_of(const simulate::Setup& setup, model::AssembledSystem& system, State& state,
                                 const model::Modes& modes) {
  system.set_modes(modes);
  system.move_to(state.t, state.q, state.v);
  system.accelerate({}, state.a, state.lambda);
  simulate::ContactScale scale(*setup.model);
  scale.take_all(system);
  simulate::ContactAudit audit;
  audit.look(system, state, scale);
  return audit.warnings(*setup.model, simulate::Ledger(system, *setup.integrator), 0);
}

// With all contacts closed, and these held by friction. Afterwards the first coordinate changes by `moved`.
std::vector<std::string> warnings_of(const std::string& scene, const std::vector<int>& held, double moved = 0) {
  simulate::Setup setup = simulate::set_up(scene::Scene::parse(scene, "test.json"), registry());
  model::AssembledSystem system(setup.model);
  model::Modes modes{.contacts = std::vector<model::ContactMode>(2), .shared = {}};
  simulate::ContactProblem problem;
  for (int i = 0; i < 2; ++i) {
    modes.contacts[std::size_t(i)].closed = true;
    problem.who.emplace_back().contact = i;
  }
  State state = setup.initial;
  system.set_modes(modes);
  system.move_to(state.t, state.q, state.v);
  for (const int i : held) {
    modes.contacts[std::size_t(i)].friction = model::ContactMode::Friction::stick;
    problem.who[std::size_t(i)].tangent = simulate::Participant::Tangent::resting;
    system.anchor(i, modes.contacts[std::size_t(i)]);
  }
  model::Modes open{.contacts = std::vector<model::ContactMode>(2), .shared = {}};
  system.set_modes(open);
  system.move_to(state.t, state.q, state.v);
  problem.prepare(system);
  modes.shared = problem.shared_rows(modes);
  state.q[0] += moved;
  return told_of(setup, system, state, modes);
}

// Its weight is 0.01 N.
TEST(ContactAudit, TellsAPullAndAFrictionBeyondItsBoundBesideAnyForceElsewhere) {
  for (const bool on_block : {false, true})
    for (const double mass : {1e-3, 1.0, 1e3, 1e6, 1e9}) {
      EXPECT_THAT(warnings_of(beside(mass, 0.005, 0.002, on_block), {0}), IsEmpty()) << mass;
      EXPECT_THAT(warnings_of(beside(mass, 0.012, 0, on_block), {0}),
                  ElementsAre(HasSubstr("contacts.ball pulled with 0.002 N")))
          << mass;
      EXPECT_THAT(warnings_of(beside(mass, 0.005, 0.003, on_block), {0}),
                  ElementsAre(HasSubstr("the friction of contacts.ball was 0.0005 N beyond its bound")))
          << mass;
    }
}

// The mode of a ball that slides at 1 m/s has a direction, that of a slip which has been missed pushes it on.
TEST(ContactAudit, TellsAFrictionAlongItsSlip) {
  const std::string scene = beside(1, 0, 0, false);
  simulate::Setup setup = simulate::set_up(scene::Scene::parse(scene, "test.json"), registry());
  model::AssembledSystem system(setup.model);
  State state = setup.initial;
  state.v[0] = 1;
  for (const double direction : {1.0, -1.0}) {
    model::Modes modes{.contacts = std::vector<model::ContactMode>(2), .shared = {}};
    modes.contacts[0].closed = true;
    modes.contacts[0].friction = model::ContactMode::Friction::slide;
    modes.contacts[0].direction = model::Tangential(direction, 0);
    const std::vector<std::string> warnings = told_of(setup, system, state, modes);
    if (direction > 0)
      EXPECT_THAT(warnings, IsEmpty());
    else
      EXPECT_THAT(warnings, ElementsAre(HasSubstr("contacts.ball pushed along its slip with 0.005 N")));
  }
}

// A slip that is round-off, in the direction that a friction pushes for a second, is no supply of energy.
TEST(ContactAudit, ReportsFrictionThatSuppliesEnergyButNotByRoundOff) {
  const std::string scene = beside(1, 0, 0, false);
  simulate::Setup setup = simulate::set_up(scene::Scene::parse(scene, "test.json"), registry());
  model::AssembledSystem system(setup.model);
  for (const double speed : {1.0, 1e-3, 1e-12, 1e-15, 1e-18}) {
    State now = setup.initial;
    now.v[0] = speed;
    model::Modes modes{.contacts = std::vector<model::ContactMode>(2), .shared = {}};
    modes.contacts[0].closed = true;
    modes.contacts[0].friction = model::ContactMode::Friction::slide;
    modes.contacts[0].direction = model::Tangential(-1, 0);
    system.set_modes(modes);
    system.move_to(now.t, now.q, now.v);
    system.accelerate({}, now.a, now.lambda);
    State next = now;
    next.t += 1, next.q[0] += speed;
    simulate::Ledger ledger(system, *setup.integrator);
    ledger.start(now), ledger.restart(now), ledger.step(now, next);
    ASSERT_LT(ledger.friction()[0], 0);
    simulate::ContactScale scale(*setup.model);
    scale.take_all(system);
    simulate::EnergyWatch energy(system, scale, ledger, 0);
    energy.look(system.energy(), true);
    const std::vector<std::string> warnings = simulate::ContactAudit().warnings(*setup.model, ledger, energy.none());
    if (speed > 1e-6)
      EXPECT_THAT(warnings, ElementsAre(HasSubstr("the friction of contacts.ball supplied"))) << speed;
    else
      EXPECT_THAT(warnings, IsEmpty()) << speed;
  }
}

// A load that takes the weight off leaves no force but what 1 N of round-off leaves of 0.
TEST(ContactAudit, DoesNotTellRoundOff) {
  for (const bool on_block : {false, true})
    for (const double part : {-1e-15, 0.0, 1e-15})
      EXPECT_THAT(warnings_of(beside(1, 0.01 * (1 + part), 0, on_block), {0}), IsEmpty()) << part;
}

// No gravity: a load presses a block on the floor, then fades away until its square is no number any more. What is left
// pulls and pushes by round-off of the largest force.
TEST(ContactAudit, DoesNotTellWhatIsLeftOfALoadThatFadedAway) {
  const std::string mu = R"({"type": "coulomb", "static": 0.4, "kinetic": 0.4})";
  for (const double at : {0.1, -0.25})
    for (const double push : {0.0, 3.0})
      for (const double width : {0.01, 0.02, 0.04}) {
        const auto fading = [width](double force) { return fmt::format("={}*exp(-((t-0.6)/{})^2)", force, width); };
        const Finished run = run_text(fmt::format(
            R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [0, 0.2],
             "markers": {{"left": [-0.3, -0.2], "right": [0.3, -0.2], "hand": [{}, 0.1]}}}}}},
  "forces": {{"load": {{"type": "load", "on": "block.hand", "force": {{"x": "{}", "y": "{}"}}}}}},
  "contacts": {{"left": {{"type": "constraint_method", "restitution": 0, "friction": {},
                        "between": ["block.left", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
               "right": {{"type": "constraint_method", "restitution": 0, "friction": {},
                         "between": ["block.right", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": 1}}, "record": {{"every": 0.02, "observe": {{"x": "block.com.x"}}}}}})",
            at, fading(push), fading(-8), mu, mu));
        ASSERT_TRUE(run.done()) << run.report.reason;
        EXPECT_TRUE(run.result["warnings"].empty()) << at << push << width << run.result["warnings"].dump();
      }
}

// A wall beside it, which the block only touches, has never had more than what is left.
TEST(ContactAudit, DoesNotTellWhatIsLeftOnAContactThatNeverCarried) {
  for (const double width : {0.02, 0.029, 0.04}) {
    const std::string mu = R"({"type": "coulomb", "static": 0.4, "kinetic": 0.4})";
    const auto fading = [width](double force) { return fmt::format("={}*exp(-((t-0.553)/{})^2)", force, width); };
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [0, 0.2],
             "markers": {{"left": [-0.3, -0.2], "right": [0.3, -0.2], "side": [-0.3, 0.05], "hand": [0.1, 0.1]}}}}}},
  "forces": {{"load": {{"type": "load", "on": "block.hand", "force": {{"x": "{}", "y": "{}"}}}}}},
  "contacts": {{"left": {{"type": "constraint_method", "restitution": 0, "friction": {},
                        "between": ["block.left", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
               "right": {{"type": "constraint_method", "restitution": 0, "friction": {},
                         "between": ["block.right", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
               "wall": {{"type": "constraint_method", "restitution": 0, "friction": {},
                        "between": ["block.side", {{"plane": {{"point": [-0.3, 0], "normal": [1, 0]}}}}]}}}},
  "simulate": {{"until": 1}}, "record": {{"every": 0.02, "observe": {{"x": "block.com.x"}}}}}})",
        fading(0.3), fading(-1), mu, mu, mu));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << width << run.result["warnings"].dump();
  }
}

// A block on two feet of 5 N, which can hold 1 N and 3 N; springs of equal stiffness would hold 2 N each. Where the
// push is no more than both can, nothing is reported; where it is, by how little.
TEST(ContactAudit, ReportsByHowLittleFeetCannotHold) {
  const auto pushed = [](double push) {
    return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": 1, "position": [0, 0],
             "markers": {{"left": [-1, 0], "right": [1, 0]}}}}}},
  "forces": {{"load": {{"type": "load", "on": "block.com", "force": {{"x": {:.17g}}}}}}},
  "contacts": {{"left": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 0.2, "kinetic": 0.2}},
                        "between": ["block.left", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
               "right": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 0.6, "kinetic": 0.6}},
                         "between": ["block.right", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": 1}}, "record": {{"every": 1, "observe": {{"x": "block.com.x"}}}}}})",
                       push);
  };
  EXPECT_THAT(warnings_of(pushed(4 - 1e-9), {0, 1}), IsEmpty());
  EXPECT_THAT(warnings_of(pushed(4 + 4e-6), {0, 1}),
              ElementsAre(HasSubstr("the friction of contacts.right was 3e-06 N beyond its bound"),
                          HasSubstr("carry 5e-06 N more than they can")));
}

// A box touches the edge of a table of its own width with a corner, and the edge touches the box. Both contacts share
// one row, until the box has moved: then the force on the edge acts elsewhere.
TEST(ContactAudit, TellsOfContactsThatHaveMovedApartButShareARow) {
  const std::string scene = R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {"box": {"type": "rigid_body", "mass": 1, "inertia": 1, "position": [0, 0], "markers": {"right": [1, 0]}},
             "table": {"type": "moving_base", "markers": {"edge": [1, 0]}}},
  "contacts": {"corner": {"type": "constraint_method",
                          "between": ["box.right", {"plane": {"point": [0, 0], "normal": [0, 1]}}]},
               "edge": {"type": "constraint_method",
                        "between": ["table.edge", {"plane": {"on": "box.com", "point": [0, 0], "normal": [0, -1]}}]}},
  "simulate": {"until": 1}, "record": {"every": 1, "observe": {"x": "box.com.x"}}})";
  EXPECT_THAT(warnings_of(scene, {}), IsEmpty());
  EXPECT_THAT(warnings_of(scene, {}, 1e-3), ElementsAre(HasSubstr("off those that move the bodies")));
}

}  // namespace
}  // namespace trammel::test
