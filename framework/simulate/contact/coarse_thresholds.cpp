#include "simulate/contact/coarse_thresholds.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

// An error a hundredth of the scene in each step is no solution of it.
constexpr double coarse = 0.01;

std::string of_step(const char* key, const StepChoice& step, double length) {
  if (step.fixed || !(step.tolerance.absolute > coarse * length)) return "";
  return fmt::format(
      "integrator.{}.absolute is {:.3g} (m, rad, m/s, rad/s), where the largest gap, body or distance of joined "
      "markers is "
      "{:.3g} m: errors of that size pass unseen. Without \"absolute\" the tolerance follows the size of the scene",
      key, step.tolerance.absolute, length);
}

// The law with the same speed a little above its capture: whether it would rebound at all.
bool rebounds(const Restitution& law, double capture_speed) {
  return law.coefficient(2 * capture_speed) > 0;
}

}  // namespace

void CoarseThresholds::look(const ContactEvent& event) {
  fastest_[event.contact] = std::max(fastest_[event.contact], event.approach);
}

std::vector<std::string> CoarseThresholds::warnings(const model::Model& model, const Settings& settings,
                                                    const ContactScale& scale) const {
  std::vector<std::string> all;
  for (const std::string& text :
       {of_step("step", settings.step, scale.scene().length()),
        settings.own_contact_step ? of_step("contact_step", settings.contact_step, scale.scene().length())
                                  : std::string()})
    if (!text.empty()) all.push_back(text);
  for (Eigen::Index i = 0; i < fastest_.size(); ++i) {
    const model::ContactEntry& contact = model.contacts[std::size_t(i)];
    if (!contact.restitution || !(fastest_[i] > 0)) continue;
    const double capture = contact.restitution->treatment().capture_speed;
    if (fastest_[i] > capture || !rebounds(*contact.restitution, capture)) continue;
    all.push_back(fmt::format(
        "no impact of {} was faster than its capture_speed of {:.3g} m/s, the fastest had {:.3g} m/s: none had a "
        "rebound. A capture_speed well below that gives them one",
        contact.path(), capture, fastest_[i]));
  }
  return all;
}

void CoarseThresholds::archive(Archive& a) {
  const Eigen::Index contacts = fastest_.size();
  a("fastest_impacts", fastest_);
  if (fastest_.size() != contacts) throw std::length_error("fastest_impacts");
}

}  // namespace trammel::simulate
