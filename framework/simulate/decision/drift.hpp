// Rule 7 of contact_mode.hpp: a slip that the steps have left in contacts at rest ends, and that of others with it.
#pragma once

#include "simulate/decision/participants.hpp"

namespace trammel::simulate {

class Drift {
 public:
  // Of a problem that is prepared.
  Drift(const ContactScene& scene, const ContactsAtEvent& at, const Participants& participants, ContactProblem& problem)
      : scene_(scene), at_(at), participants_(participants), problem_(problem) {}

  // Adds to changes.stopped the sliding contacts whose slip follows from the rates of the contacts at rest and of the
  // closed rows. True if there are any.
  bool stop_with_others(ContactChanges& changes) const;
  // Ends the drift of the contacts at rest. True if this has ended the slip of sliding contacts too; they are added to
  // changes.stopped.
  bool end_drift(State& state, ContactChanges& changes, bool jumped);

 private:
  const ContactScene& scene_;
  const ContactsAtEvent& at_;
  const Participants& participants_;
  ContactProblem& problem_;
};

}  // namespace trammel::simulate
