// A point of 2 kg on a floor, at an event: what the rules of contacts are handed, without a run.
#pragma once

#include <string>

#include "simulate/contact/contact_scene.hpp"
#include "simulate/start/setup.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

#include "support/run_scene.hpp"

namespace trammel::test {

struct PointAtEvent {
  // mu_0 = 0.5, mu = 0.4, e = 0.5; the contact was open and has no rate.
  explicit PointAtEvent(const std::string& gravity, const std::string& velocity = "[0, 0]")
      : setup(simulate::set_up(
            scene::Scene::parse(text, "test.json", {{"gravity", gravity}, {"bodies.ball.velocity", velocity}}),
            registry())),
        system(setup.model),
        scale(*setup.model),
        state(setup.initial) {
    model::Modes open;
    open.contacts.resize(1);
    system.set_modes(open);
    system.move_to(state.t, state.q, state.v);
    scale.take_all(system);
    at.before = at.modes = open;
    at.shared_before = {false};
    at.touching = {{.contact = 0}};
    at.largest = {0};
  }
  model::ContactMode& mode() { return at.modes.contacts[0]; }

  static constexpr const char* text =
      R"({"trammel": 1, "space": "planar", "bodies": {"ball": {"type": "point_mass", "mass": 2, "position": [0, 0]}},
          "contacts": {"floor": {"type": "constraint_method", "restitution": 0.5,
                                 "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
                                 "friction": {"type": "coulomb", "static": 0.5, "kinetic": 0.4}}},
          "integrator": {"type": "runge_kutta_4", "step": 1e-3}, "simulate": {"until": 1},
          "record": {"every": 0.1, "observe": {"y": "ball.point.y"}}})";
  simulate::Setup setup;
  model::AssembledSystem system;
  simulate::ContactScale scale;
  State state;
  simulate::ContactScene scene{system, scale, setup.settings.contact_step, setup.settings.chatter_steps};
  simulate::ContactsAtEvent at;
};

}  // namespace trammel::test
