#include "simulate/contact/coarse_thresholds.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "simulate/contact/law_speeds.hpp"

namespace trammel::simulate {
namespace {

// If each step may be wrong by a hundredth of the scene's size, the result is no solution.
constexpr double coarse = 0.01;

std::string of_step(const char* key, const StepChoice& step, double length) {
  if (step.fixed || !(step.tolerance.absolute > coarse * length)) return "";
  return fmt::format(
      "integrator.{}.absolute is {:.3g} (m, rad, m/s, rad/s), where the largest gap, body or distance of joined "
      "markers is {:.3g} m: errors of that size pass unseen. Without \"absolute\" the tolerance follows the size of "
      "the scene",
      key, step.tolerance.absolute, length);
}

// Evaluates the law just above its capture speed: would it rebound at all?
bool rebounds(const Restitution& law, double capture_speed) {
  return law.coefficient(2 * capture_speed) > 0;
}

std::string of_impacts(const model::ContactEntry& contact, const Scale& scale, double fastest) {
  const double capture = capture_speed(contact, scale);
  if (!(fastest > scale.rest_speed()) || fastest > capture || !rebounds(*contact.restitution, capture)) return "";
  if (contact.restitution->treatment().capture_speed > 0)
    return fmt::format(
        "no impact of {} was faster than its capture_speed of {:.3g} m/s, the fastest had {:.3g} m/s: none had a "
        "rebound. A capture_speed well below that gives them one",
        contact.path(), capture, fastest);
  return fmt::format(
      "no impact of {} was faster than {:.3g} m/s, a part of the scene's speed below which impacts have no "
      "rebound, the fastest had {:.3g} m/s. A capture_speed well below that gives them one",
      contact.path(), capture, fastest);
}

std::string of_slips(const model::ContactEntry& contact, double fastest) {
  const double named = contact.coulomb->stick_speed();
  if (!(fastest > 0) || fastest * coarse > named || !(named > 0)) return "";
  return fmt::format(
      "{}.friction.stick_speed is {:.3g} m/s, the fastest slip was {:.3g} m/s: what is slower than the former "
      "sticks at once. Without it the stick speed follows the scene's",
      contact.path(), named, fastest);
}

// [m/s] The speed at which the law would reach its full force if it kept its slope at 0. A law that throws here is
// reported by the run, where it acts.
double creep_speed(const SmoothFriction& law) try {
  constexpr double any_slip = 1e300;
  return law.ratio(any_slip) / law.slope(0);
} catch (...) {
  return 0;
}

// A fastest slip that hardly exceeds the creep speed of the law, over a long distance, is the creep itself.
std::string of_creep(const model::ContactEntry& contact, double fastest, double duration, double length) {
  constexpr double hardly_faster = 10;
  const double creep = creep_speed(*contact.smooth);
  if (!(creep > 0) || !(fastest * duration > coarse * length) || fastest > hardly_faster * creep) return "";
  return fmt::format(
      "the fastest slip of {} was {:.3g} m/s, and its friction law creeps with speeds up to about {:.3g} m/s "
      "instead of sticking: use a critical_velocity well below the slips, or coulomb",
      contact.path(), fastest, creep);
}

}  // namespace

void CoarseThresholds::look(const ContactEvent& event) {
  fastest_[event.contact] = std::max(fastest_[event.contact], event.approach);
}

void CoarseThresholds::look_at_slips(model::AssembledSystem& system, const ContactScale& scale) {
  for (Eigen::Index i = 0; i < fastest_slip_.size(); ++i) {
    const model::ContactEntry& contact = system.model().contacts[std::size_t(i)];
    const bool judged = contact.coulomb ? contact.coulomb->stick_speed() > 0 : contact.smooth && !contact.surface;
    if (!judged) continue;
    const bool touches = system.modes().contacts[std::size_t(i)].closed || contact.joint ||
                         system.gap(int(i)) <= scale.of(int(i)).touching();
    if (touches) fastest_slip_[i] = std::max(fastest_slip_[i], system.slip(int(i)).norm());
  }
}

std::vector<std::string> CoarseThresholds::warnings(const model::Model& model, const Settings& settings,
                                                    const ContactScale& scale) const {
  std::vector<std::string> all;
  const auto add = [&all](const std::string& text) {
    if (!text.empty()) all.push_back(text);
  };
  for (const std::string& text :
       {of_step("step", settings.step, scale.scene().length()),
        settings.own_contact_step ? of_step("contact_step", settings.contact_step, scale.scene().length())
                                  : std::string()})
    add(text);
  for (Eigen::Index i = 0; i < fastest_.size(); ++i) {
    const model::ContactEntry& contact = model.contacts[std::size_t(i)];
    if (contact.restitution) add(of_impacts(contact, scale.of(int(i)), fastest_[i]));
    if (contact.coulomb) add(of_slips(contact, fastest_slip_[i]));
    if (contact.smooth)
      add(of_creep(contact, fastest_slip_[i], settings.until - settings.start, scale.scene().length()));
  }
  return all;
}

void CoarseThresholds::archive(Archive& a) {
  const Eigen::Index contacts = fastest_.size();
  a("fastest_impacts", fastest_), a("fastest_slips", fastest_slip_);
  if (fastest_.size() != contacts) throw std::length_error("fastest_impacts");
  if (fastest_slip_.size() != contacts) throw std::length_error("fastest_slips");
}

}  // namespace trammel::simulate
