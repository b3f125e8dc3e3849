// The parts of the equations at a point without an AssembledSystem around them, for two bodies: a drawer that rubs in
// its guide, and a slider on a turning arm whose tip rubs along a plane.
#pragma once

#include "model/build.hpp"
#include "system/equations/factors.hpp"
#include "system/equations/shared_rows.hpp"

#include "support/made.hpp"

namespace trammel::test {

inline constexpr const char* drawer_and_slider = R"({
  "trammel": 1, "gravity": [0, -9.81],
  "bodies": {
    "drawer": {"type": "rigid_body", "mass": 2, "inertia": 0.1, "markers": {"handle": [0.05, 0.3]}},
    "arm": {"type": "rigid_body", "mass": 1.5, "inertia": 0.2, "angle": 0.4, "position": [2, 0]},
    "slider": {"type": "rigid_body", "mass": 0.7, "inertia": 0.05, "angle": 0.4, "position": [2.3, 0.2],
               "markers": {"tip": [0.4, -0.1]}}
  },
  "joints": {
    "guide": {"type": "prismatic", "between": ["ground", "drawer.com"], "length": 0.4,
              "friction": {"type": "coulomb", "static": 0.25, "kinetic": 0.25}},
    "pin": {"type": "revolute", "between": ["ground", "arm.com"]},
    "rail": {"type": "prismatic", "between": ["arm.com", "slider.com"]}
  },
  "forces": {"spring": {"type": "spring_damper", "between": ["drawer.handle", "slider.com"], "stiffness": 40,
                        "damping": 3, "length": 1}},
  "contacts": {"tip": {"type": "constraint_method", "restitution": 0,
                       "between": ["slider.tip", {"plane": {"point": [0, 0.4], "normal": [0.1, 1]}}],
                       "friction": {"type": "coulomb", "static": 0.6, "kinetic": 0.4}}},
  "integrator": {"type": "dop853"}, "simulate": {"until": 1}
})";

inline std::shared_ptr<const model::Model> two_bodies() {
  const scene::Scene scene = scene::Scene::parse(drawer_and_slider, "drawer_and_slider.json");
  scene::Problems problems;
  const std::shared_ptr<const model::Model> model = model::build(scene.root(), registry(), problems);
  problems.throw_if_any();
  return model;
}

// Dense, everything closed; what has friction slides.
struct TestParts {
  TestParts() : TestParts(two_bodies()) {}
  explicit TestParts(std::shared_ptr<const model::Model> model) : at(std::move(model)) {
    model::Modes modes;
    modes.contacts.assign(std::size_t(contacts.count()),
                          {.closed = true, .friction = model::ContactMode::Friction::slide, .direction = {1, 0}});
    contacts.set_modes(modes);
    int row = at.model->sizes.nc;
    const int held = row;
    for (int i = 0; i < contacts.count(); ++i)
      if (contacts.entry(i).restitution) contacts.loads.set_row({i, 0}, row++);
    rows.lay_out(row, held);
    shares.lay_out();
    Vec q(at.model->sizes.nq), v(at.model->sizes.nv);
    for (const model::BodyEntry& body : at.model->bodies)
      body.body->initial(q.segment(body.q0, body.nq), v.segment(body.v0, body.nv));
    move_to(q, v + Vec::LinSpaced(v.size(), 0.2, 1));
  }
  void move_to(const Vec& q, const Vec& v) {
    at.move_to(0, q, v);
    masses.moved();
    rows.forget();
    rows.evaluate();
  }
  int in_joint() const {
    for (int i = 0;; ++i)
      if (contacts.in_joint(i)) return i;
  }

  model::Counts counts;
  model::Point at;
  model::ContactsAtPoint contacts{at};
  model::JointFriction friction{at, contacts};
  model::RowsAtPoint rows{at, contacts, friction, nullptr};
  model::MassAndForceAtPoint masses{at, contacts, nullptr, false, counts};
  model::TangentAtPoint tangent{at, contacts, friction};
  model::FactorsAtPoint factors{at, contacts, rows, masses, tangent, nullptr, false, counts};
  model::ImpulseResponse response{at, contacts, rows, masses, nullptr, false};
  model::SharedRowsAtPoint shares{at, contacts, friction, rows, response};
};

}  // namespace trammel::test
