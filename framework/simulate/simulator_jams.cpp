// What a run does where the forces of sliding contacts and joints grow without bound or cease to exist.
#include <algorithm>
#include <utility>
#include <vector>

#include "simulate/simulator.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

// A state whose distance from Painleve's critical state (ContactModes::distance_from_critical) is less counts as that
// state. Friction that is larger by `past_critical` times the distance is beyond it.
constexpr double at_critical = 1e-4, past_critical = 10;

}  // namespace

// True if sliding joints lock at the present state. Trial steps have ended there up to round-off.
bool Simulator::locks_here() {
  const auto slides = [this](std::size_t i) {
    return system_.model().contacts[i].joint &&
           system_.modes().contacts[i].friction == model::ContactMode::Friction::slide;
  };
  bool any = false;
  for (std::size_t i = 0; i < system_.modes().contacts.size(); ++i) any = any || slides(i);
  if (!any) return false;
  try {
    system_.move_to(now_.t, now_.q, now_.v);
    system_.accelerate({}, inside_.a, inside_.lambda);
    return false;
  } catch (const model::LocksItself&) {
    return true;
  }
}

// Near Painleve's critical state the forces of sliding contacts grow without end within a finite time, and steps become
// too short. Slightly larger friction is beyond that state, where an impact without collision ends the slip.
bool Simulator::near_critical_state() {
  const double distance = modes_.distance_from_critical(now_);
  raised_ = past_critical * distance;
  return distance < at_critical;
}

// A force that changes its sign through infinity looks like a release.
bool Simulator::passes_infinity(const ContactChanges& changes) {
  const auto slides = [](const model::ContactMode& m) {
    return m.closed && m.friction == model::ContactMode::Friction::slide;
  };
  const std::vector<model::ContactMode>& contacts = system_.modes().contacts;
  return !changes.released.empty() && std::any_of(contacts.begin(), contacts.end(), slides) && near_critical_state();
}

// A joint that locks itself while it slides comes to rest where it is.
void Simulator::jam(RecordSink& recorder, double h) {
  locked_ = false;
  ContactChanges changes;
  changes.locked = true;
  changes.raised = std::exchange(raised_, 0.0);
  settle(changes);
  write_events(recorder);
  guard_against_standstill(0, h, -1);
}

}  // namespace trammel::simulate
