#include "simulate/event_location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "linear/dense/eps.hpp"
#include "simulate/contact/signed_loads.hpp"
#include "simulate/root_bracket.hpp"
#include "simulate/trial_step.hpp"

namespace trammel::simulate {
namespace {

using Friction = model::ContactMode::Friction;

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

void EventLocation::watch_all() {
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) watch(i);
  const std::vector<model::SharedRows>& shared = system_.modes().shared;
  for (std::size_t group = 0; group < shared.size(); ++group)
    watches_.push_back({.contact = shared[group].implied.front().contact, .kind = Kind::follow, .group = int(group)});
}

void EventLocation::watch(int contact) {
  const model::ContactEntry& entry = system_.model().contacts[contact];
  const model::ContactMode& mode = system_.modes().contacts[contact];
  if (entry.joint) {
    watch_loads(contact);
    return watch_friction(contact, false);
  }
  if (!mode.closed) {
    const bool at_ends = entry.restitution && entry.restitution->treatment().onset == Restitution::Onset::next_step;
    watches_.push_back(
        {.contact = contact, .kind = Kind::approach, .at_ends = at_ends, .noise = scale_.of(contact).touching()});
    return;
  }
  if (entry.restitution && entry.restitution->treatment().release == Restitution::Release::never) return;
  const model::AssembledSystem::Sharing sharing = system_.sharing(contact);
  const bool as_one = sharing.group >= 0 && !sharing.as_spring;
  if (as_one && !watched_group(sharing.group))
    watches_.push_back({.contact = contact, .kind = Kind::unload, .group = sharing.group});
  if (entry.force)
    watches_.push_back({.contact = contact, .kind = Kind::leave, .noise = scale_.of(contact).touching()});
  else if (!as_one)
    watches_.push_back({.contact = contact, .kind = sharing.idle ? Kind::idle : Kind::press});
  watch_friction(contact, as_one);
}

// `as_one`: the force that holds it is watched together with those that share rows with it.
void EventLocation::watch_friction(int contact, bool as_one) {
  const model::ContactEntry& entry = system_.model().contacts[contact];
  const model::ContactMode& mode = system_.modes().contacts[contact];
  if (mode.friction == Friction::slide)
    watches_.push_back({.contact = contact, .kind = Kind::slide, .noise = scale_.of(contact).at_rest()});
  else if (mode.friction == Friction::stick && !as_one)
    watches_.push_back({.contact = contact,
                        .kind = Kind::hold,
                        .at_ends = entry.coulomb->decide() == SetValuedFriction::Decide::every_evaluation});
}

// Loads of a sticking joint bound the friction that holds it; those of a sliding joint decide its motion.
void EventLocation::watch_loads(int contact) {
  if (system_.modes().contacts[contact].friction == Friction::none) return;
  const int count = count_signed_loads(system_.model(), contact);
  for (int k = 0; k < count; ++k) watches_.push_back({.contact = contact, .kind = Kind::load, .bearing = k});
}

// Sets the side on which bearings press: the present one, or the other one if the load has just passed through 0.
void EventLocation::choose_sides(const std::vector<Watch>& before) {
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    Watch& watch = watches_[w];
    if (watch.kind != Kind::load) continue;
    const bool passed = before.size() == watches_.size() && before[w].reported;
    watch.side = passed ? -before[w].side : now_[w].f < 0 ? -1 : 1;
    now_[w].f *= watch.side;
    watch.noise = std::max(modes_.friction_noise(watch.contact), 1e-12 * watch.bound);
  }
}

// Friction that holds exactly at its bound (equal blocks that brake as one) leaves no spare load, up to round-off. It
// must not hide a loss of load of the other contacts.
void EventLocation::allow_for_critical_friction() {
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    Watch& watch = watches_[w];
    if (watch.kind != Kind::unload) continue;
    const double more = std::max(0.0, 1e-9 * watch.bound - watch.little);
    watch.little += more, now_[w].f += more;
  }
}

bool EventLocation::watched_group(int group) const {
  return std::any_of(watches_.begin(), watches_.end(), [group](const Watch& w) { return w.group == group; });
}

namespace {

bool same_modes(const std::vector<model::ContactMode>& a, const std::vector<model::ContactMode>& b) {
  const auto same = [](const model::ContactMode& x, const model::ContactMode& y) {
    return x.closed == y.closed && x.friction == y.friction && x.direction.dot(y.direction) >= 0;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

}  // namespace

void EventLocation::restart(const State& now) {
  std::vector<Watch> before;
  if (same_modes(modes_before_, system_.modes().contacts)) before.swap(watches_);
  modes_before_ = system_.modes().contacts;
  watches_.clear();
  h_before_ = longest_ = 0;
  system_.move_to(now.t, now.q, now.v);
  watch_all();
  for (Watch& each : watches_) {
    if (each.kind == Kind::unload) each.little = little_force(each.group);
    if (each.kind == Kind::follow) each.little = 10 * modes_.nothing();
    if (each.kind == Kind::hold) each.little = little_friction(each.contact);
  }
  next_.resize(watches_.size()), probe_.resize(watches_.size());
  sign_ = evaluate(now, now_);
  allow_for_critical_friction();
  choose_sides(before);
  for (Watch& watch : watches_) measure_slow(0, now, watch);
  for (std::size_t w = 0; w < watches_.size(); ++w) watches_[w].steepest = std::abs(now_[w].slope);
  for (std::size_t w = 0; w < before.size() && before.size() == watches_.size(); ++w)
    wait_longer(before[w], now_[w], watches_[w]);
  // A contact begins to stick at its bound where its normal force begins at 0, and where mu = mu_0.
  for (int w = 0; w < int(watches_.size()); ++w)
    if (watches_[w].kind == Kind::hold && !watches_[w].at_ends &&
        now_[w].f <= std::max(1e-9 * watches_[w].bound, watches_[w].little))
      watches_[w].noise = std::max(modes_.friction_noise(watches_[w].contact), watches_[w].little);
}

double EventLocation::longest_step(double swings) const {
  const bool matter =
      h_before_ == 0 || swings_matter(now_, 5 * h_before_);  // a step is five times the last one at most
  const double resolved =
      matter && watches() ? between_states_.longest_resolved() : std::numeric_limits<double>::infinity();
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    if (watches_[w].kind == Kind::hold || watches_[w].kind == Kind::unload) return std::min(swings, resolved);
    if (watches_[w].kind == Kind::slide) longest = std::min(longest, now_[w].f / (4 * watches_[w].steepest));
  }
  return std::min(std::max(swings, longest), resolved);
}

double EventLocation::little_force(int group) {
  const model::SharedRows& shared = system_.modes().shared[std::size_t(group)];
  std::vector<model::ContactDirection> all = shared.basis;
  all.insert(all.end(), shared.implied.begin(), shared.implied.end());
  return modes_.force_noise(all);
}

// Of a compliant contact that only touches: its depth is round-off, and so is its force.
double EventLocation::little_friction(int contact) {
  const model::ContactEntry& entry = system_.model().contacts[std::size_t(contact)];
  if (!entry.force || !entry.coulomb) return 0;
  const double approach = system_.modes().contacts[std::size_t(contact)].approach_speed;
  return entry.coulomb->static_coefficient() * entry.force->normal(-scale_.of(contact).touching(), 0, approach);
}

EventLocation::Value EventLocation::slide(int contact, const Vec& a) {
  const model::Tangential& direction = system_.modes().contacts[contact].direction;
  return {direction.dot(system_.slip(contact)), direction.dot(system_.slip_acceleration(contact, a))};
}

// At the system's point.
bool EventLocation::slow(const Watch& watch) {
  return watch.kind == Kind::slide && system_.tangents(watch.contact) > 1 &&
         system_.slip(watch.contact).norm() < system_.modes().contacts[std::size_t(watch.contact)].slow;
}

// A slip that stays below `slow` for ten times the time in which its acceleration would pass `slow` is held: friction
// whose direction is not resolved there acts as a stiff damper that other sticking contacts balance. At the system's
// point, the end of the step.
bool EventLocation::stalls(double h, const State& next, int w) {
  const Watch& watch = watches_[std::size_t(w)];
  if (!slow(watch)) return false;
  const double pushed = std::max(watch.pushed, system_.slip_acceleration(watch.contact, next.a).norm());
  return (watch.slow_for + h) * pushed > 10 * system_.modes().contacts[std::size_t(watch.contact)].slow;
}

void EventLocation::measure_slow(double h, const State& next, Watch& watch) {
  if (!slow(watch)) {
    watch.slow_for = watch.pushed = 0;
    return;
  }
  watch.slow_for += h;
  watch.pushed = std::max(watch.pushed, system_.slip_acceleration(watch.contact, next.a).norm());
}

void EventLocation::accept(double h, const State& next) {
  system_.move_to(next.t, next.q, next.v);
  for (Watch& watch : watches_) measure_slow(h, next, watch);
  system_.step_taken();
  if (system_.model().world.space == Space::spatial)  // along their present directions
    for (std::size_t w = 0; w < watches_.size(); ++w)
      if (watches_[w].kind == Kind::slide) next_[w] = slide(watches_[w].contact, next.a);
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    watches_[w].force_before = now_[w].f;
    watches_[w].steepest = std::max(watches_[w].steepest, std::abs(next_[w].slope));
  }
  h_before_ = h;
  sign_ = sign_next_;
  now_.swap(next_);
}

double EventLocation::force(Watch& watch, double t, const Vec& lambda) {
  if (watch.kind == Kind::idle) return -system_.spring_force(watch.contact, lambda);
  if (watch.kind == Kind::unload) {
    watch.bound = system_.largest_load(watch.group, lambda);
    return watch.little + system_.spare_load(watch.group, lambda);
  }
  const double N = system_.normal_force(watch.contact, lambda);
  if (watch.kind == Kind::load) {
    watch.bound = N;
    return watch.side * signed_loads(system_, watch.contact, t, lambda)[std::size_t(watch.bearing)];
  }
  if (watch.kind == Kind::hold) watch.bound = system_.model().contacts[watch.contact].coulomb->static_coefficient() * N;
  return watch.kind == Kind::press ? N : watch.bound - system_.friction_force(watch.contact, lambda).norm();
}

int EventLocation::evaluate(const State& state, std::vector<Value>& values) {
  system_.move_to(state.t, state.q, state.v);
  values.resize(watches_.size());
  bool accelerated = false;
  for (std::size_t w = 0; w < watches_.size(); ++w) values[w] = value(int(w), state, accelerated);
  return accelerated ? system_.sign() : 0;
}

// The watched function at `state`, the system's point. `accelerated`: a_ and lambda_ have been solved at this point.
EventLocation::Value EventLocation::value(int w, const State& state, bool& accelerated) {
  const auto accelerate = [&] {
    if (!std::exchange(accelerated, true)) system_.accelerate({}, a_, lambda_);
  };
  Watch& watch = watches_[std::size_t(w)];
  if (watch.kind == Kind::slide) return slide(watch.contact, state.a);
  if (watch.kind == Kind::follow) {
    accelerate();
    return {watch.little - system_.departure(watch.group, a_), 0};
  }
  if (!by_force(w)) {
    const double sign = watch.kind == Kind::leave ? -1 : 1;
    return {sign * system_.gap(watch.contact), sign * system_.gap_rate(watch.contact)};
  }
  if (watch.kind == Kind::hold && watch.at_ends)
    return {scale_.of(watch.contact).no_acceleration() - system_.slip_acceleration(watch.contact, state.a).norm(), 0};
  if (!own_force_) accelerate();
  return {force(watch, state.t, own_force_ ? state.lambda : lambda_), 0};
}

// Just after an event, a function at the round-off of 0 proves nothing unless it goes on falling; a function that began
// below 0 (a drifted row, an onset that was not located) proves nothing unless it falls further.
bool EventLocation::happened(int w, const Value& end) const {
  if (!(end.f < 0)) return false;
  if (!just_handled(w) || end.f < std::min(now_[w].f, 0.0) - watches_[w].noise) return true;
  return watches_[w].kind != Kind::slide && !by_force(w) && end.slope < -scale_.of(watches_[w].contact).at_rest();
}

EventLocation::Value EventLocation::step_to(const State& now, double h, int w) {
  if (h != h_tried_) {
    ++steps_tried_;
    h_tried_ = 0;
    if (!trial_step(integrator_, system_, now, h, trial_)) throw StepRefused{};
    h_tried_ = h;
  }
  system_.move_to(trial_.t, trial_.q, trial_.v);
  bool accelerated = false;
  return value(w, trial_, accelerated);
}

void EventLocation::find_suspects(const State& now, double h, const State& next) {
  for (int w = 0; w < int(watches_.size()); ++w) {
    Suspect suspect{w, h, next_[w]};
    if (watches_[w].at_ends) {
      if (next_[w].f < 0 && (by_force(w) || next_[w].slope < -scale_.of(watches_[w].contact).at_rest()))
        at_end_.push_back(w);
    } else if (happened(w, next_[w]) || dips(now, h, next, w, suspect) || returns(now, h, w, suspect)) {
      suspects_.push_back(suspect);
    } else if (watches_[w].kind == Kind::slide) {
      system_.move_to(next.t, next.q, next.v);
      if (stalls(h, next, w)) at_end_.push_back(w);
    }
  }
}

// Orders suspects by the crossings that values and slopes at the ends predict. The first is then located first, and the
// others are seen to come later.
void EventLocation::earliest_first(std::vector<Suspect>& suspects) const {
  const auto crossing = [this](const Suspect& s) {
    const Value& begin = now_[s.watch];
    if (!(begin.f > 0 && s.at_high.f < 0)) return s.high;
    if (!has_slope(s.watch)) return s.high * begin.f / (begin.f - s.at_high.f);
    return numerics::crossing_of_cubic({0, s.high, begin, s.at_high});
  };
  for (Suspect& s : suspects) s.about = crossing(s);
  std::stable_sort(suspects.begin(), suspects.end(), [](const auto& a, const auto& b) { return a.about < b.about; });
}

EventLocation::Found EventLocation::examine(const State& now, double& h, State& next, bool controlled,
                                            bool may_shorten) {
  sign_next_ = evaluate(next, next_);
  for (const Value& value : next_)
    if (!std::isfinite(value.f)) return Found::not_finite;
  if (controlled && sign_ * sign_next_ < 0) return Found::passes_infinity;
  probed_ = false;
  if (may_shorten && hides(now, h, next)) return Found::step_too_long;
  suspects_.clear();
  at_end_.clear();
  changes_.clear();
  h_tried_ = 0;
  begin_slopes_.clear(), end_slopes_.clear();
  int first = -1;
  try {
    find_suspects(now, h, next);
    if (suspects_.empty()) {
      if (at_end_.empty()) return Found::nothing;
      for (const int w : at_end_) report(w);
      return Found::event;
    }
    earliest_first(suspects_);
    double h_event = h;
    for (Suspect& suspect : suspects_) {
      if (suspect.high > h_event) {  // only if it precedes the earliest event so far
        const Value there = step_to(now, h_event, suspect.watch);
        if (!happened(suspect.watch, there)) continue;
        suspect.high = h_event, suspect.at_high = there;
      }
      const double located = locate(now, suspect);
      if (first < 0 || located < h_event) first = suspect.watch;
      h_event = std::min(h_event, located);
    }
    h_event = std::min(h, std::max(h_event, 4 * eps * std::max(std::abs(now.t), std::abs(now.t + h))));
    if (h_event < h) {
      if (h_event == h_tried_)
        next = trial_;
      else if (++steps_tried_; !trial_step(integrator_, system_, now, h_event, next))
        return Found::step_refused;
      sign_next_ = evaluate(next, next_);
      h = h_event;
      if (controlled && sign_ * sign_next_ < 0) return Found::passes_infinity;
    }
  } catch (const StepRefused&) {
    return Found::step_refused;
  }
  report(first);
  collect();
  return Found::event;
}

// An event that changed nothing was round-off, or the missing force is too small to move anything yet. It is an event
// again when several times as much is missing.
void EventLocation::wait_longer(const Watch& before, const Value& now, Watch& watch) const {
  if (watch.kind == Kind::load) return;
  watch.noise = std::max(watch.noise, before.noise);
  if (before.reported || now.f < 0)
    watch.noise = std::max({watch.noise, watch.little, 2 * std::abs(now.f), 4 * before.noise});
}

void EventLocation::report(int w) {
  const int contact = watches_[w].contact;
  watches_[w].reported = true;
  const auto add = [contact](std::vector<int>& list) {
    if (std::find(list.begin(), list.end(), contact) == list.end()) list.push_back(contact);
  };
  switch (watches_[w].kind) {
    case Kind::approach:
      return add(system_.model().contacts[contact].restitution ? changes_.struck : changes_.toggled);
    case Kind::leave:
      return add(changes_.toggled);
    case Kind::press:
    case Kind::idle:
    case Kind::unload:
    case Kind::follow:
      return add(changes_.released);
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
  for (int w = 0; w < int(watches_.size()); ++w) {
    const Value& end = next_[w];
    const Scale scale = scale_.of(watches_[w].contact);
    const bool falls = end.slope < -scale.at_rest();
    if (watches_[w].at_ends ? end.f < 0 && (by_force(w) || falls)
        : by_force(w)       ? end.f <= 1e-12 * watches_[w].bound && !just_handled(w)
        : watches_[w].kind == Kind::slide
            ? end.f <= watches_[w].noise && !just_handled(w) && end.slope < -scale.no_acceleration()
            : end.f <= same_instant(watches_[w].contact) && falls)
      report(w);
  }
}

double EventLocation::locate(const State& now, const Suspect& suspect) {
  const int w = suspect.watch;
  const double resolution = 2 * eps * std::max(std::abs(now.t), std::abs(now.t + suspect.high));
  numerics::FallingBracket bracket{0, suspect.high, now_[w], suspect.at_high};
  if (just_handled(w)) {  // look at a time when it was apart
    double apart = suspect.high;
    bool found = false;
    while (!found && apart > resolution) {
      apart /= 2;
      const Value there = step_to(now, apart, w);
      if (there.f > 0)
        bracket.low = apart, bracket.at_low = there, found = true;
      else if (happened(w, there))
        bracket.high = apart, bracket.at_high = there;
      else  // so near that nothing shows yet: a step to there would find no event, without end
        break;
    }
    if (!found) return bracket.high;
  }
  if (!has_slope(w)) {
    const auto f = [&](double h) { return step_to(now, h, w).f; };
    return numerics::narrow(f, {bracket.low, bracket.high, bracket.at_low.f, bracket.at_high.f}, resolution).high;
  }
  // A thousandth of `same_instant`.
  const Scale scale = scale_.of(watches_[w].contact);
  const double round_off = 1e-3 * (watches_[w].kind == Kind::slide ? scale.at_rest() : scale.touching());
  return numerics::crossing([&](double h) { return step_to(now, h, w); }, bracket, resolution, round_off);
}

void EventLocation::archive(Archive& a) {
  const auto n = Eigen::Index(watches_.size());
  Mat values(n, 9);
  for (Eigen::Index w = 0; w < n; ++w)
    values.row(w) << now_[w].f, now_[w].slope, watches_[w].noise, watches_[w].force_before, watches_[w].steepest,
        watches_[w].little, watches_[w].side, watches_[w].slow_for, watches_[w].pushed;
  Vec flat = Eigen::Map<const Vec>(values.data(), values.size());
  a("watched", flat), a("h_before", h_before_), a("longest", longest_), a("steps_tried", steps_tried_),
      a("sign", sign_);
  if (watches_.empty() && flat.size() > 0) {  // in reading an archive: watches are set up after the modes
    watch_all();
    next_.resize(watches_.size()), probe_.resize(watches_.size()), now_.resize(watches_.size());
  }
  modes_before_ = system_.modes().contacts;
  const auto m = Eigen::Index(watches_.size());
  if (flat.size() != 9 * m) throw std::length_error("watched");
  for (Eigen::Index w = 0; w < m; ++w) {
    now_[w] = {flat[w], flat[m + w]};
    watches_[w].noise = flat[2 * m + w], watches_[w].force_before = flat[3 * m + w],
    watches_[w].steepest = flat[4 * m + w], watches_[w].little = flat[5 * m + w], watches_[w].side = flat[6 * m + w];
    watches_[w].slow_for = flat[7 * m + w], watches_[w].pushed = flat[8 * m + w];
  }
}

}  // namespace trammel::simulate
