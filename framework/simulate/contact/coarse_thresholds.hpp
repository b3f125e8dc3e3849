// Thresholds that exceed the motion to which they apply: they then hide the motion itself.
//
//     threshold                             what it decides                    compared with
//     integrator.step.absolute              the error that a step may make     the scene's size (ContactScale)
//     contacts.NAME.capture_speed           slower impacts have no rebound     the contact's fastest impact
//     contacts.NAME.friction.stick_speed    slower slips stick                 the contact's fastest slip
//     creep of a smooth friction law        it creeps in place of sticking     the contact's fastest slip
//
// The capture speed is compared also if it is derived from the scene's speed.
#pragma once

#include <string>
#include <vector>

#include <trammel/archive.hpp>

#include "run/contact_scale.hpp"
#include "run/settings.hpp"
#include "simulate/results/contact_event.hpp"

namespace trammel::simulate {

class CoarseThresholds {
 public:
  explicit CoarseThresholds(const model::Model& model)
      : fastest_(Vec::Zero(Eigen::Index(model.contacts.size()))), fastest_slip_(fastest_) {}
  void look(const ContactEvent& event);                                           // an impact
  void look_at_slips(model::AssembledSystem& system, const ContactScale& scale);  // at its point
  std::vector<std::string> warnings(const model::Model& model, const Settings& settings,
                                    const ContactScale& scale) const;
  void archive(Archive& a);

 private:
  Vec fastest_;       // [m/s] approach, by contact; 0: it has not struck
  Vec fastest_slip_;  // [m/s] by contact, where it touches
};

}  // namespace trammel::simulate
