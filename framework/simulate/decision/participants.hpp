// Who takes part in the problem of one instant: contacts that touch without a rate (rule 3 of contact_mode.hpp), joints
// that rub, compliant contacts at rest in the tangent; and whether each is at rest or slides (rule 5).
#pragma once

#include <vector>

#include "simulate/contact/contact_changes.hpp"
#include "simulate/contact/contact_scene.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

// What the participants are gathered for. The system is at `state`.
struct Occasion {
  const State& state;
  const ContactChanges& changes;  // seen there
  bool jumped;                    // v
};

class Participants {
 public:
  Participants(const ContactScene& scene, ContactsAtEvent& at) : scene_(scene), at_(at) {}

  std::vector<int> candidates(const ContactChanges& changes) const;
  // The candidates, then the others. Sets in at.modes the friction of compliant contacts, which take no part if they
  // slide.
  std::vector<Participant> gather(const std::vector<int>& candidates, const Occasion& now);
  void add_friction(const Occasion& now, Participant& p) const;  // at rest or sliding, and its coefficients
  // Takes all whose forces are sought out of these modes.
  void open_all(model::Modes& modes) const;
  // At the system's point and in its modes: sets the participants' accelerations without the forces sought, their
  // given normal forces, and at.largest.
  void accelerate(ContactProblem& problem);
  double least_acceleration(int contact) const;  // [m/s^2] a smaller one counts as no acceleration

 private:
  void add_set_valued_friction(const Occasion& now, const SetValuedFriction& law, const Tangential& slip,
                               Participant& p) const;
  double error_of_impact(int contact) const;
  double unresolved(int contact, const State& state) const;
  void gather_compliant(int contact, const Occasion& now, std::vector<Participant>& who);

  const ContactScene& scene_;
  ContactsAtEvent& at_;
};

}  // namespace trammel::simulate
