// Thresholds that are larger than the motion that they judge: what they let pass then is the motion itself.
//
//     integrator.step.absolute       an error that steps may make, beside the scene's size (ContactScale)
//     contacts.NAME.capture_speed    below which impacts have no rebound, beside the fastest impact of the contact;
//                                    also where the scene's speed stands for it
//     contacts.NAME.friction.stick_speed    below which it sticks, beside the fastest slip of the contact
//     the creep of a smooth friction law    in place of sticking, beside the same
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
