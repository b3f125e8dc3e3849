#include "simulate/event/event_location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "linear/dense/eps.hpp"
#include "simulate/contact/force_noise.hpp"
#include "simulate/event/root_bracket.hpp"
#include "simulate/event/trial_step.hpp"

namespace trammel::simulate {
namespace {

// A part of a row that does not follow from those with which its contact shares: contacts that touched at one point
// have moved apart. It exceeds `no_share` (complementarity/shares/row_basis.cpp), so the other rows on which it depends
// show.
constexpr double most_off_span = 5e-9;
constexpr double part_of_scale = 1e-3;  // of what counts as touching or at rest: a function located so near is at 0
// Of `least_acceleration`: an implied direction that accelerates no more than this is still held.
constexpr double held_acceleration = 10;
constexpr double most_lengthening = 5;  // of the last step, as in StepControl: the next one is no longer
constexpr double part_of_slip = 0.25;   // the most that a step may take from a slip at its steepest rate
constexpr double units_in_t = 4;        // units in the last place of t: the shortest step
constexpr Eigen::Index archived = 10;   // numbers of each function in a checkpoint

// [s] To an event.
double shortest_step(double t) {
  return units_in_t * eps * std::abs(t);
}

// Thrown and caught in this file: the integrator refused one of the steps that locate an event.
struct StepRefused {};

}  // namespace

EventLocation::EventLocation(model::AssembledSystem& system, Integrator& integrator, ContactModes& modes,
                             const ContactScale& scale)
    : system_(system),
      integrator_(integrator),
      modes_(modes),
      scale_(scale),
      between_states_(system, integrator),
      own_force_(!integrator.traits().holds_position && !integrator.traits().holds_velocity) {}

namespace {

// Whether slips have the same sense, too.
bool same_modes(const std::vector<model::ContactMode>& a, const std::vector<model::ContactMode>& b) {
  const auto same = [](const model::ContactMode& x, const model::ContactMode& y) {
    return x.closed == y.closed && x.friction == y.friction && x.direction.dot(y.direction) >= 0;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool same_springs(const std::vector<model::ContactMode>& a, const std::vector<model::ContactMode>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const model::ContactMode& x, const model::ContactMode& y) { return x.spring == y.spring; });
}

}  // namespace

// A basis of rows has its group, whichever of them are implied. A contact that becomes idle is watched by the same
// force, that of a spring.
EventLocation::Watched EventLocation::watched(const EventFunction& f) const {
  const bool of_group = f.kind == Kind::follow || f.kind == Kind::lean || f.kind == Kind::span;
  return {f.kind == Kind::idle ? Kind::press : f.kind, of_group ? f.group : f.contact, f.bearing};
}

void EventLocation::restart(const State& now) {
  std::map<Watched, EventFunction> before;
  if (same_modes(modes_before_, system_.modes().contacts))
    for (const EventFunction& each : functions_) before.emplace(watched(each), each);
  other_springs_ = !same_springs(modes_before_, system_.modes().contacts);
  functions_.clear();
  at_once_ = h_before_ > 0 && h_before_ <= 2 * shortest_step(now.t);
  h_before_ = longest_ = 0;
  system_.move_to(now.t, now.q, now.v);
  set_up_functions();
  set_thresholds();
  next_.resize(functions_.size()), probe_.resize(functions_.size());
  evaluate(now, now_, signs_);
  allow_for_round_off(now);
  choose_sides(before);
  for (EventFunction& function : functions_) measure_undirected(0, now, function);
  keep_what_was_learnt(before);
  allow_for_friction_at_bounds();
}

// The values that count as 0, by kind.
void EventLocation::set_thresholds() {
  const std::vector<double> little = little_forces();
  for (EventFunction& each : functions_) {
    if (each.kind == Kind::unload || is_shared_force(each)) each.little = little[std::size_t(each.group)];
    if (each.kind == Kind::press && each.group < 0) each.little = force_noise(system_, scale_, {{each.contact, 0}});
    if (each.kind == Kind::follow) each.little = held_acceleration * modes_.least_acceleration(each.contact);
    if (each.kind == Kind::span) each.little = std::max(most_off_span, 2 * system_.off_span(each.group));
    if (each.kind == Kind::hold) each.little = little_friction(each.contact);
  }
}

// From the functions that watched the same before.
void EventLocation::keep_what_was_learnt(const std::map<Watched, EventFunction>& before) {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    functions_[k].steepest = std::abs(now_[k].slope);
    const auto same = before.find(watched(functions_[k]));
    if (same == before.end()) continue;
    if (functions_[k].kind == Kind::follow)  // a change of bases does not know the accelerations without forces
      functions_[k].little = std::max(functions_[k].little, same->second.little);
    wait_longer(same->second, int(k));
  }
}

// A contact begins to stick at its bound where its normal force begins at 0, and where mu = mu_0.
void EventLocation::allow_for_friction_at_bounds() {
  for (int k = 0; k < int(functions_.size()); ++k)
    if (functions_[k].kind == Kind::hold && !functions_[k].at_ends &&
        now_[k].f <= std::max(critical_force * functions_[k].bound, functions_[k].little))
      functions_[k].noise =
          std::max({functions_[k].noise, friction_noise(system_, scale_, functions_[k].contact), functions_[k].little});
}

double EventLocation::longest_step(double swings) const {
  const bool matter = h_before_ == 0 || swings_matter(now_, most_lengthening * h_before_);
  const double resolved =
      matter && has_contacts() ? between_states_.longest_resolved() : std::numeric_limits<double>::infinity();
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    if (functions_[k].kind == Kind::hold || functions_[k].kind == Kind::unload) return std::min(swings, resolved);
    if (functions_[k].kind == Kind::slide)
      longest = std::min(longest, part_of_slip * now_[k].f / functions_[k].steepest);
  }
  return std::min(std::max(swings, longest), resolved);
}

void EventLocation::accept(double h, const State& next) {
  system_.move_to(next.t, next.q, next.v);
  for (EventFunction& function : functions_) measure_undirected(h, next, function);
  system_.step_taken();
  if (system_.model().world.space == Space::spatial) {  // along their present directions
    for (std::size_t k = 0; k < functions_.size(); ++k)
      if (functions_[k].kind == Kind::slide) next_[k] = slide(functions_[k].contact, next.a);
    modes_before_ = system_.modes().contacts;
  }
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    functions_[k].force_before = now_[k].f;
    functions_[k].steepest = std::max(functions_[k].steepest, std::abs(next_[k].slope));
  }
  h_before_ = h;
  std::swap(signs_, signs_next_);
  now_.swap(next_);
}

// True if the function shows that its event happened before `end`. Just after an event, a function at the round-off of
// 0 proves nothing unless it falls on, faster than an impact may have left it: the same impact would follow without
// end. A function that began below 0 (a drifted row, an onset that was not located) proves nothing unless it falls
// further.
bool EventLocation::happened(const State& now, int k, const Value& end) {
  if (!(end.f < 0)) return false;
  if (!just_handled(k) || end.f < std::min(now_[k].f, 0.0) - functions_[k].noise) return true;
  return functions_[k].kind != Kind::slide && !by_force(k) &&
         end.slope < -scale_.of(functions_[k].contact).left_by_impacts() && !grazes(now, k);
}

// A gap that touches and closes, but opens again by its own acceleration before it is as deep as what counts as
// touching. Contacts that depend on each other leave such rates: a box that tips about its feet moves its lowest corner
// against a wall until it lands, by a distance that nothing resolves. An impact would move the feet, and their friction
// would restore the rate, again and again.
bool EventLocation::grazes(const State& now, int k) {
  const double rate = now_[k].slope, acceleration = gap_acceleration(now, k);
  return rate < 0 && acceleration > 0 && now_[k].f - rate * rate / (2 * acceleration) > -functions_[k].noise;
}

// [m/s^2] Of an event function that is a gap, or minus a gap.
double EventLocation::gap_acceleration(const State& now, int k) {
  system_.move_to(now.t, now.q, now.v);
  return (functions_[k].kind == Kind::leave ? -1 : 1) * system_.acceleration({functions_[k].contact, 0}, now.a);
}

EventLocation::Value EventLocation::step_to(const State& now, double h, int k) {
  if (h != h_tried_) {
    ++steps_tried_;
    h_tried_ = 0;
    if (!trial_step(integrator_, system_, now, h, trial_)) throw StepRefused{};
    h_tried_ = h;
  }
  system_.move_to(trial_.t, trial_.q, trial_.v);
  bool accelerated = false;
  return value(k, trial_, accelerated);
}

void EventLocation::find_suspects(const State& now, double h, const State& next) {
  for (int k = 0; k < int(functions_.size()); ++k) {
    Suspect suspect{k, h, next_[k]};
    if (functions_[k].kind == Kind::lean) {
      if (next_[k].f < -functions_[k].noise) at_end_.push_back(k);
    } else if (functions_[k].at_ends) {
      if (next_[k].f < 0 && (by_force(k) || next_[k].slope < -scale_.of(functions_[k].contact).rest_speed()))
        at_end_.push_back(k);
    } else if (happened(now, k, next_[k]) || dips(now, h, next, k, suspect) || returns(now, h, k, suspect)) {
      suspects_.push_back(suspect);
    } else if (functions_[k].kind == Kind::slide) {
      system_.move_to(next.t, next.q, next.v);
      if (stalls(h, next, k)) at_end_.push_back(k);
    }
  }
}

// Orders suspects by the crossings that values and slopes at the ends predict. After the first is located, most others
// need only one step, which shows that they come later.
void EventLocation::earliest_first(std::vector<Suspect>& suspects) const {
  const auto crossing = [this](const Suspect& s) {
    const Value& begin = now_[s.function];
    if (!(begin.f > 0 && s.at_high.f < 0)) return s.high;
    if (!has_slope(s.function)) return s.high * begin.f / (begin.f - s.at_high.f);
    return numerics::crossing_of_cubic({0, s.high, begin, s.at_high});
  };
  for (Suspect& s : suspects) s.about = crossing(s);
  std::stable_sort(suspects.begin(), suspects.end(), [](const auto& a, const auto& b) { return a.about < b.about; });
}

EventLocation::Found EventLocation::examine(const State& now, double& h, State& next, Steps steps) {
  const auto passes_infinity = [&] { return steps != Steps::fixed && any_opposite(signs_, signs_next_); };
  evaluate(next, next_, signs_next_);
  for (const Value& value : next_)
    if (!std::isfinite(value.f)) return Found::not_finite;
  if (passes_infinity()) return Found::passes_infinity;
  forget_trials();
  if (steps == Steps::controlled && hides(now, h, next)) return Found::step_too_long;
  try {
    find_suspects(now, h, next);
    if (suspects_.empty()) {
      for (const int k : at_end_) functions_[k].stalled = functions_[k].kind == Kind::slide, report(k);
      return at_end_.empty() ? Found::nothing : Found::event;
    }
    const Located first = locate_first(now, h);
    if (first.h < h) {
      shorten(now, first.h, h, next);
      if (passes_infinity()) return Found::passes_infinity;
    }
    report(first.function);
  } catch (const StepRefused&) {
    return Found::step_refused;
  }
  collect();
  return Found::event;
}

void EventLocation::forget_trials() {
  probed_ = false;
  suspects_.clear();
  at_end_.clear();
  changes_.clear();
  h_tried_ = 0;
  begin_slopes_.clear(), end_slopes_.clear();
}

// The earliest event of the suspects. Only those that precede the earliest one so far are located.
EventLocation::Located EventLocation::locate_first(const State& now, double h) {
  earliest_first(suspects_);
  Located first{-1, h};
  for (Suspect& suspect : suspects_) {
    if (suspect.high > first.h) {
      const Value there = step_to(now, first.h, suspect.function);
      if (!happened(now, suspect.function, there)) continue;
      suspect.high = first.h, suspect.at_high = there;
    }
    const double located = locate(now, suspect);
    if (first.function < 0 || located < first.h) first.function = suspect.function;
    first.h = std::min(first.h, located);
  }
  const double shortest = shortest_step(std::max(std::abs(now.t), std::abs(now.t + h)));
  first.h = std::min(h, std::max(first.h, shortest));
  return first;
}

// h and next become those of the step to the event.
void EventLocation::shorten(const State& now, double h_event, double& h, State& next) {
  if (h_event == h_tried_)
    next = trial_;
  else if (++steps_tried_; !trial_step(integrator_, system_, now, h_event, next))
    throw StepRefused{};
  evaluate(next, next_, signs_next_);
  h = h_event;
}

// An event that changed nothing was round-off, or the missing force is too small to move anything yet. It is an event
// again when several times as much is missing. So was one that follows another of the same function after the shortest
// step: whatever the function was in between, it jumps there by its error.
void EventLocation::wait_longer(const EventFunction& before, int k) {
  EventFunction& function = functions_[std::size_t(k)];
  const Value& now = now_[std::size_t(k)];
  if (function.kind == Kind::load || function.kind == Kind::span) return;
  if (function.kind == Kind::lean) {  // there is no better basis
    if (now.f < 0) function.noise = 2 * std::abs(now.f);
    return;
  }
  if (before.stalled) {  // its zero has not been seen: it slides on, and grows slowly
    function.patience = 4 * before.patience, function.noise = std::max(function.noise, before.noise);
    return;
  }
  function.patience = before.patience;
  if (function.kind == Kind::approach && now.slope > scale_.of(function.contact).left_by_impacts()) return;  // rebounds
  function.noise = std::max(function.noise, before.noise);
  if (now.f < 0 || (before.reported && (at_once_ || !shares_otherwise(k))))
    function.noise = std::max({function.noise, function.little, 2 * std::abs(now.f), 4 * before.noise});
}

void EventLocation::report(int k) {
  const int contact = functions_[k].contact;
  functions_[k].reported = true;
  const auto add = [contact](std::vector<int>& list) {
    if (std::find(list.begin(), list.end(), contact) == list.end()) list.push_back(contact);
  };
  switch (functions_[k].kind) {
    case Kind::approach:
      return add(system_.model().contacts[contact].restitution ? changes_.struck : changes_.toggled);
    case Kind::leave:
      return add(changes_.toggled);
    case Kind::unload:
      add(changes_.unloaded);
      return add(changes_.released);
    case Kind::press:
    case Kind::idle:
    case Kind::follow:
      return add(changes_.released);
    case Kind::lean:
    case Kind::span:
      changes_.leaning = true;
      return;
    case Kind::hold:
      return add(changes_.yielded);
    case Kind::load:  // all modes are decided again
      return;
    case Kind::slide:
      return add(changes_.stopped);
  }
}

// [m, rad] A gap below this happens at the same instant. Where a truss unfolds into its singular position, the rows
// that keep its cells alike have double roots, so their round-off determines the cells only to half of the digits.
// Latches tied by such rows lock as one; otherwise nothing could move for the late ones.
double EventLocation::same_instant(int contact) const {
  const bool by_double_root = system_.model().contacts[contact].limit && system_.redundant();
  return by_double_root ? std::sqrt(eps) * scale_.of(contact).length() : 4 * scale_.of(contact).touching();
}

// Adds all other events of the instant that was located.
void EventLocation::collect() {
  for (int k = 0; k < int(functions_.size()); ++k)
    if (happens_with_others(k)) report(k);
}

// At the located instant, the end of the shortened step.
bool EventLocation::happens_with_others(int k) {
  const EventFunction& function = functions_[k];
  const Value& end = next_[k];
  const Scale scale = scale_.of(function.contact);
  const bool falls = end.slope < -scale.rest_speed();
  if (function.kind == Kind::lean || function.kind == Kind::span) return false;  // other rows follow the event
  if (function.at_ends) return end.f < 0 && (by_force(k) || falls);
  if (by_force(k)) return end.f <= vanished_force * function.bound && !just_handled(k);
  if (function.kind == Kind::slide)
    return end.f <= function.noise && !just_handled(k) && end.slope < -scale.no_acceleration();
  return end.f <= same_instant(function.contact) && falls;
}

double EventLocation::locate(const State& now, const Suspect& suspect) {
  const int k = suspect.function;
  const double resolution = 2 * eps * std::max(std::abs(now.t), std::abs(now.t + suspect.high));
  numerics::FallingBracket bracket{0, suspect.high, now_[k], suspect.at_high};
  if (just_handled(k)) {  // look at a time when it was apart
    double apart = suspect.high;
    bool found = false;
    while (!found && apart > resolution) {
      apart /= 2;
      const Value there = step_to(now, apart, k);
      if (there.f > 0)
        bracket.low = apart, bracket.at_low = there, found = true;
      else if (happened(now, k, there))
        bracket.high = apart, bracket.at_high = there;
      else  // so near that nothing shows yet: a step to there would find no event, without end
        break;
    }
    if (!found) return bracket.high;
  }
  if (!has_slope(k)) {
    const auto f = [&](double h) { return step_to(now, h, k).f; };
    return numerics::narrow(f, {bracket.low, bracket.high, bracket.at_low.f, bracket.at_high.f}, resolution).high;
  }
  const Scale scale = scale_.of(functions_[k].contact);
  const double round_off = part_of_scale * (functions_[k].kind == Kind::slide ? scale.rest_speed() : scale.touching());
  return numerics::crossing([&](double h) { return step_to(now, h, k); }, bracket, resolution, round_off);
}

void EventLocation::archive(Archive& a) {
  const auto n = Eigen::Index(functions_.size());
  Mat values(n, archived);
  for (Eigen::Index k = 0; k < n; ++k)
    values.row(k) << now_[k].f, now_[k].slope, functions_[k].noise, functions_[k].force_before, functions_[k].steepest,
        functions_[k].little, functions_[k].side, functions_[k].undirected_for, functions_[k].pushed,
        functions_[k].patience;
  Vec flat = Eigen::Map<const Vec>(values.data(), values.size());
  a("watched", flat), a("h_before", h_before_), a("longest", longest_), a("steps_tried", steps_tried_);
  signs_.archive(a, "signs");
  if (functions_.empty() && flat.size() > 0) {  // in reading an archive: watches are set up after the modes
    set_up_functions();
    next_.resize(functions_.size()), probe_.resize(functions_.size()), now_.resize(functions_.size());
  }
  const auto m = Eigen::Index(functions_.size());
  if (flat.size() != archived * m) throw std::length_error("watched");
  for (Eigen::Index k = 0; k < m; ++k) {
    now_[k] = {flat[k], flat[m + k]};
    functions_[k].noise = flat[2 * m + k], functions_[k].force_before = flat[3 * m + k],
    functions_[k].steepest = flat[4 * m + k], functions_[k].little = flat[5 * m + k],
    functions_[k].side = flat[6 * m + k];
    functions_[k].undirected_for = flat[7 * m + k], functions_[k].pushed = flat[8 * m + k];
    functions_[k].patience = flat[9 * m + k];
  }
}

}  // namespace trammel::simulate
