// `restart: carry`: the forces before an event, from which the multipliers of the new rows start.
#pragma once

#include <vector>

#include "simulate/contact/contact_changes.hpp"
#include "simulate/contact/contact_scene.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

class CarriedForces {
 public:
  explicit CarriedForces(const ContactScene& scene) : scene_(scene) {}

  void keep(const State& state, const model::Modes& before);  // stores the forces, if any contact may carry them
  // At this event a contact that closes or opens carries its force.
  bool asked(const ContactsAtEvent& at, const ContactChanges& changes) const;
  // Sets multipliers that stand for the stored forces in the system's modes; for rows that depend on each other, for
  // their resultants.
  void take(Vec& lambda) const;

 private:
  const ContactScene& scene_;
  std::vector<Eigen::Vector3d> forces_;  // by contact and direction [N]
  Vec lambda_;
};

}  // namespace trammel::simulate
