// Rules 3, 5 and 6 of contact_mode.hpp: which contacts close, stick and slide by the forces that the problem has found.
#pragma once

#include "simulate/contact/contact_scene.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

class Verdicts {
 public:
  // Of a problem that is solved.
  Verdicts(const ContactScene& scene, ContactsAtEvent& at, const ContactProblem& problem)
      : scene_(scene), at_(at), problem_(problem) {}

  void take();  // sets at.modes of all participants
  // Without its own force its gap would not accelerate more than by round-off. All forces of an island may be as small
  // (a lid from which Coriolis' force lifts a box).
  bool would_hardly_close(std::size_t participant) const;
  double least_acceleration(const Participant& p) const;  // [m/s^2] of a solution with the violation found

 private:
  bool merely_touches(std::size_t participant, double largest) const;
  void take(const Participant& p, bool closed);

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  const ContactProblem& problem_;
};

}  // namespace trammel::simulate
