// Thresholds of a scene that are larger than the motion that they judge: what they let pass then is the motion itself.
//
//     integrator.step.absolute       an error that steps may make, beside the scene's size (ContactScale)
//     contacts.NAME.capture_speed    below which impacts have no rebound, beside the fastest impact of the contact
#pragma once

#include <string>
#include <vector>

#include <trammel/archive.hpp>

#include "simulate/results/contact_event.hpp"
#include "run/contact_scale.hpp"
#include "run/settings.hpp"

namespace trammel::simulate {

class CoarseThresholds {
 public:
  explicit CoarseThresholds(const model::Model& model) { fastest_.setZero(Eigen::Index(model.contacts.size())); }
  void look(const ContactEvent& event);  // an impact
  std::vector<std::string> warnings(const model::Model& model, const Settings& settings,
                                    const ContactScale& scale) const;
  void archive(Archive& a);

 private:
  Vec fastest_;  // [m/s] approach, by contact; 0: it has not struck
};

}  // namespace trammel::simulate
