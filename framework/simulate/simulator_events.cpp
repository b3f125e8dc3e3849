// Events of a run: the consequences of a change of contacts or of a refinement, and limits of their number.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "linear/dense/eps.hpp"
#include "plugin/breadcrumb.hpp"
#include "run/run_failed.hpp"
#include "simulate/simulator.hpp"

namespace trammel::simulate {

namespace {

constexpr double window_of_storm = 1e-3;                           // of the run, in which simulate.event_limit holds
constexpr double standstill = 64 * eps;                            // of the time: a step up to this does not advance it
constexpr int most_standing = 100, most_standing_of_contact = 10;  // events in a row: in all, and more for each contact

}  // namespace

void Simulator::settle(const ContactChanges& changes) {
  const std::size_t before = events_.size();
  modes_.settle(now_, changes, events_);
  ledger_.moving_rows(-modes_.lost_elsewhere());
  for (const ImpactLoss& loss : modes_.losses()) ledger_.impact(loss.contact, loss.energy);
  for (std::size_t i = before; i < events_.size(); ++i) {
    ++statistics_.events;
    if (events_[i].kind == ContactEvent::Kind::close) ++statistics_.touches;
    if (events_[i].kind != ContactEvent::Kind::impact && events_[i].kind != ContactEvent::Kind::latch) continue;
    ++statistics_.impacts;
    thresholds_.look(events_[i]);
  }
  window_events_ += 1;
  hold_until_ = now_.t + settings_.contact_hold;
  audit_.look(system_, now_, scale_);
  at_new_modes();
}

// No event: only the rows in g change, and no force. False: it is an event.
bool Simulator::renew_bases() {
  if (!modes_.renew_bases(now_)) return false;
  at_new_modes();
  return true;
}

// No event: nothing moves, and no force that acts on the motion changes. False: it is an event.
bool Simulator::renew_springs() {
  if (!modes_.renew_springs(now_)) return false;
  location_.restart(now_);
  return true;
}

void Simulator::at_new_modes() {
  integrator_.restart(system_, now_);
  restart_all_but_integrator();
}

void Simulator::restart_all_but_integrator() {
  in_contact_ = any_closed(system_);
  step_limit_ =
      control().controlled() ? longest_step_in_contact(system_, now_) : std::numeric_limits<double>::infinity();
  free_control_.interrupted();
  contact_control_.interrupted();
  for (const LevelCorrection& entry : corrections_) {
    const plugin::Breadcrumb goes_on(*entry.origin, "restart");
    entry.correction->restart(system_, now_);
  }
  location_.restart(now_);
  ledger_.restart(now_);
  statistics_.note_sizes(now_.t, system_.sizes());
}

// ", the last of contacts.tip"
std::string Simulator::last_of(int contact) const {
  return contact < 0 ? "" : ", the last of " + system_.model().contacts[std::size_t(contact)].path();
}

// Events in a row that hardly advance t are a contradiction in the model, not a motion: its modes exclude each other.
void Simulator::guard_against_standstill(double h, double wanted, int contact) {
  standing_ = h <= standstill * (std::abs(now_.t) + wanted) ? standing_ + 1 : 0;
  const int contacts = int(system_.model().contacts.size());
  if (standing_ <= most_standing + most_standing_of_contact * contacts) return;
  const bool last_is_rigid = contact >= 0 && system_.model().contacts[std::size_t(contact)].restitution;
  const bool rigid = last_is_rigid || any_rigid_closed(system_);
  throw RunFailed(fmt::format(
      "{}: {} events in a row without progress in time{}: the contacts' modes contradict each other{}; {}, has one",
      here(), standing_, last_of(contact),
      rigid ? ", as they do where much friction leaves no motion of rigid contacts" : "", other_law(rigid)));
}

void Simulator::guard_against_storm(int contact) {
  const double window = (settings_.until - settings_.start) * window_of_storm;
  if (now_.t > window_start_ + window) window_start_ = now_.t, window_events_ = 1;
  if (window_events_ <= settings_.event_limit) return;
  throw RunFailed(
      fmt::format("event storm {}: more than {} events within {:.3g} s{}; raise capture_speed of that contact, or "
                  "simulate.event_limit if they are real",
                  here(), settings_.event_limit, now_.t - window_start_, last_of(contact)));
}

// An impact after which the contact stays closed is two events but one blow.
void Simulator::write_events(RecordSink& recorder) {
  for (const ContactEvent& event : events_) recorder.event(event), last_motions_.take(event);
  if (refinement_.possible())
    for (const int contact : struck_contacts()) refine(recorder, contact);
  events_.clear();
}

std::vector<int> Simulator::struck_contacts() const {
  std::vector<int> struck;
  for (const ContactEvent& event : events_)
    if (event.kind == ContactEvent::Kind::close || event.kind == ContactEvent::Kind::impact)
      if (std::find(struck.begin(), struck.end(), event.contact) == struck.end()) struck.push_back(event.contact);
  return struck;
}

// `contact`: the one that has just closed, -1 after a step.
void Simulator::refine(RecordSink& recorder, int contact) {
  const Transfer* transfer = refinement_.refine(now_, contact);
  if (!transfer) return;
  if (!integrator_.traits().events) fail(0, "a body refined, and this integrator takes no events");
  for (const RefineEvent& event : refinement_.events()) recorder.event(event);
  ledger_.refinement(refinement_.gained());
  if (auto* resizable = dynamic_cast<Resizable*>(&integrator_))
    resizable->resize(system_, *transfer, now_);
  else
    integrator_.restart(system_, now_);
  restart_all_but_integrator();
  measure_joints();
}

}  // namespace trammel::simulate
