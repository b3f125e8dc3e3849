#include "simulate/event/event_location.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "simulate/event/earlier_events.hpp"
#include "simulate/event/functions_of_modes.hpp"
#include "simulate/event/onsets.hpp"
#include "simulate/event/thresholds.hpp"

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;

// Adds the change that the function's event is.
void report(EventFunction& function, const model::Model& model, ContactChanges& changes) {
  function.reported = true;
  const auto add = [contact = function.contact](std::vector<int>& list) {
    if (!contains(list, contact)) list.push_back(contact);
  };
  switch (function.kind) {
    case Kind::approach:
      return add(model.contacts[std::size_t(function.contact)].restitution ? changes.struck : changes.toggled);
    case Kind::leave:
      return add(changes.toggled);
    case Kind::unload:
      add(changes.unloaded);
      return add(changes.released);
    case Kind::press:
    case Kind::idle:
    case Kind::follow:
      return add(changes.released);
    case Kind::lean:
    case Kind::span:
      changes.leaning = true;
      return;
    case Kind::hold:
      return add(changes.yielded);
    case Kind::load:  // all modes are decided again
      return;
    case Kind::slide:
      return add(changes.stopped);
  }
}

bool happens_too(const EventFunction& function, const model::AssembledSystem& system, const Scale& scale) {
  const ValueAndSlope& end = function.next;
  const bool falls = end.slope < -scale.rest_speed();
  if (function.kind == Kind::lean || function.kind == Kind::span) return false;  // other rows follow the event
  if (function.at_ends) return end.f < 0 && (function.by_force() || falls);
  if (function.by_force()) return end.f <= vanished_force * function.bound && !function.just_handled();
  if (function.kind == Kind::slide)
    return end.f <= function.noise && !function.just_handled() && end.slope < -scale.no_acceleration();
  const bool touches = function.together || end.f <= same_instant(system, function.contact, scale);
  return touches && falls && !function.grazed;
}

// Adds the changes of all functions whose event is at the same instant: the end of the step, which was shortened to the
// first event.
void report_others(std::vector<EventFunction>& functions, const model::AssembledSystem& system,
                   const ContactScale& scale, ContactChanges& changes) {
  for (EventFunction& function : functions)
    if (happens_too(function, system, scale.of(function.contact))) report(function, system.model(), changes);
}

}  // namespace

EventLocation::EventLocation(model::AssembledSystem& system, Integrator& integrator, ContactModes& modes,
                             const ContactScale& scale)
    : system_(system),
      modes_(modes),
      scale_(scale),
      values_(system, integrator, scale),
      trials_(system, integrator, values_, scale),
      search_(system, values_, trials_),
      resolution_(system, integrator, values_, scale) {}

void EventLocation::restart(const State& now) {
  const std::vector<model::ContactMode>& modes = system_.modes().contacts;
  LastChange change{.other_springs = !same_springs(modes_before_, modes),
                    .at_once = h_before_ > 0 && h_before_ <= 2 * shortest_step(now.t)};
  if (same_modes(modes_before_, modes)) change.before = by_what_they_watch(functions_);
  h_before_ = 0;
  resolution_.restart();
  system_.move_to(now.t, now.q, now.v);
  set_up_functions();
  set_thresholds(functions_, system_, scale_, modes_);
  evaluate(&EventFunction::now, now, signs_);
  allow_for_round_off(functions_, system_, scale_, values_.forces(now));
  choose_sides(functions_, change);
  measure_undirected_slips(0, now);
  keep_what_was_learnt(functions_, change, scale_);
  allow_for_friction_at_bounds(functions_, system_, scale_);
}

void EventLocation::set_up_functions() {
  modes_before_ = system_.modes().contacts;
  functions_ = functions_of_modes(system_, scale_);
}

void EventLocation::evaluate(ValueAndSlope EventFunction::*where, const State& state, numerics::BlockSigns& signs) {
  if (values_.fill(functions_, where, state))
    system_.find_signs(signs);
  else
    signs.clear();
}

EventLocation::Found EventLocation::examine(const State& now, double& h, State& next, Steps steps) {
  evaluate(&EventFunction::next, next, signs_next_);
  for (const EventFunction& function : functions_)
    if (!std::isfinite(function.next.f)) return Found::not_finite;
  if (passes_infinity(steps)) return Found::passes_infinity;
  changes_.clear();
  trials_.start_at(now);
  for (EventFunction& function : functions_) function.inside.reset();
  if (steps == Steps::controlled && resolution_.hides({now, h, next, h_before_}, functions_))
    return Found::step_too_long;
  try {
    return locate(now, h, next, steps);
  } catch (const StepRefused&) {
    return Found::step_refused;
  }
}

EventLocation::Found EventLocation::locate(const State& now, double& h, State& next, Steps steps) {
  const EventSearch::Shown shown = search_.look({now, h, next, h_before_}, functions_);
  if (shown.within.empty()) {
    for (EventFunction* function : shown.at_end) {
      function->undirected.stalled = function->kind == Kind::slide;
      report(*function, system_.model(), changes_);
    }
    return shown.at_end.empty() ? Found::nothing : Found::event;
  }
  const Located first = locate_first(shown.within, now.t, h, trials_);
  if (first.h < h) {
    trials_.take(first.h, next);
    evaluate(&EventFunction::next, next, signs_next_);
    h = first.h;
    if (passes_infinity(steps)) return Found::passes_infinity;
  }
  mark_grazes(functions_, system_, scale_, values_, next);
  mark_together(functions_, *first.function, system_, scale_, next);
  const bool passes = first.function->grazed;
  if (!passes) report(*first.function, system_.model(), changes_);
  report_others(functions_, system_, scale_, changes_);
  return passes && changes_.empty() ? Found::nothing : Found::event;
}

double EventLocation::longest_step(double swings) const {
  if (!has_contacts()) return std::numeric_limits<double>::infinity();
  return resolution_.longest_step(functions_, h_before_, swings);
}

void EventLocation::accept(double h, const State& next) {
  system_.move_to(next.t, next.q, next.v);
  measure_undirected_slips(h, next);
  system_.step_taken();
  const bool turns = system_.model().world.space == Space::spatial;
  for (EventFunction& function : functions_) {
    if (turns && function.kind == Kind::slide)  // along its present direction
      function.next = values_.slip(function.contact, next.a);
    function.before = function.now.f;
    function.steepest = std::max(function.steepest, std::abs(function.next.slope));
    function.now = function.next;
  }
  if (turns) modes_before_ = system_.modes().contacts;
  h_before_ = h;
  std::swap(signs_, signs_next_);
}

void EventLocation::measure_undirected_slips(double h, const State& next) {
  for (EventFunction& function : functions_)
    if (function.kind == Kind::slide) function.undirected.measure(system_, function.contact, h, next);
}

void EventLocation::archive(Archive& a) {
  const auto numbers = [](EventFunction& f) {
    return std::array{&f.now.f,
                      &f.now.slope,
                      &f.noise,
                      &f.before,
                      &f.steepest,
                      &f.little,
                      &f.side,
                      &f.undirected.lasted,
                      &f.undirected.pushed,
                      &f.undirected.patience};
  };
  const std::size_t n = functions_.size(), kept = std::tuple_size_v<decltype(numbers(functions_[0]))>;
  Vec flat(Eigen::Index(kept * n));  // number by number
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < kept; ++i) flat[Eigen::Index(i * n + k)] = *numbers(functions_[k])[i];
  a("watched", flat), a("h_before", h_before_);
  resolution_.archive(a);
  a("steps_tried", trials_.count);
  signs_.archive(a, "signs");
  if (functions_.empty() && flat.size() > 0) set_up_functions();  // in reading: watches are set up after the modes
  const std::size_t m = functions_.size();
  if (std::size_t(flat.size()) != kept * m) throw std::length_error("watched");
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t i = 0; i < kept; ++i) *numbers(functions_[k])[i] = flat[Eigen::Index(i * m + k)];
}

}  // namespace trammel::simulate
