// The functions whose zeros are events: which ones the present modes have, and their values.
#include <algorithm>
#include <cmath>
#include <utility>

#include "simulate/contact/force_noise.hpp"
#include "simulate/contact/signed_loads.hpp"
#include "simulate/event/event_location.hpp"

namespace trammel::simulate {
namespace {

using Friction = model::ContactMode::Friction;

// Rates of the rows in g appear at most as many times in the rows that follow from them, and so do drifts.
constexpr double most_leverage = 10;

}  // namespace

void EventLocation::set_up_functions() {
  modes_before_ = system_.modes().contacts;
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) add_functions(i);
  const std::vector<model::SharedRows>& shared = system_.modes().shared;
  for (std::size_t group = 0; group < shared.size(); ++group) {
    const int contact = shared[group].implied.front().contact;
    functions_.push_back({.contact = contact, .kind = Kind::follow, .group = int(group)});
    functions_.push_back({.contact = contact, .kind = Kind::lean, .at_ends = true, .group = int(group)});
    functions_.push_back({.contact = contact, .kind = Kind::span, .group = int(group)});
  }
}

void EventLocation::add_functions(int contact) {
  const model::ContactEntry& entry = system_.model().contacts[contact];
  const model::ContactMode& mode = system_.modes().contacts[contact];
  const model::AssembledSystem::Sharing sharing = system_.sharing(contact);
  const bool as_one = sharing.shared && !sharing.as_spring;
  if (entry.joint) {
    add_loads(contact);
    if (as_one) add_unload(contact, sharing.group);
    return add_friction(contact, as_one);
  }
  if (!mode.closed) {
    const bool at_ends = entry.restitution && entry.restitution->treatment().onset == Restitution::Onset::next_step;
    functions_.push_back(
        {.contact = contact, .kind = Kind::approach, .at_ends = at_ends, .noise = scale_.of(contact).touching()});
    return;
  }
  if (entry.restitution && entry.restitution->treatment().release == Restitution::Release::never) return;
  if (as_one) add_unload(contact, sharing.group);
  if (entry.force)
    functions_.push_back({.contact = contact, .kind = Kind::leave, .noise = scale_.of(contact).touching()});
  else if (!as_one)
    functions_.push_back({.contact = contact, .kind = sharing.idle ? Kind::idle : Kind::press, .group = sharing.group});
  add_friction(contact, as_one);
}

// One for all that share.
void EventLocation::add_unload(int contact, int group) {
  if (!unloads(group)) functions_.push_back({.contact = contact, .kind = Kind::unload, .group = group});
}

// `as_one`: the spare load of those that share rows with it covers the force that holds it.
void EventLocation::add_friction(int contact, bool as_one) {
  const model::ContactEntry& entry = system_.model().contacts[contact];
  const model::ContactMode& mode = system_.modes().contacts[contact];
  if (mode.friction == Friction::slide)
    functions_.push_back({.contact = contact, .kind = Kind::slide, .noise = scale_.of(contact).rest_speed()});
  else if (mode.friction == Friction::stick && !as_one)
    functions_.push_back({.contact = contact,
                          .kind = Kind::hold,
                          .at_ends = entry.coulomb->decide() == SetValuedFriction::Decide::every_evaluation});
}

// Loads of a sticking joint bound the friction that holds it; those of a sliding joint decide its motion.
void EventLocation::add_loads(int contact) {
  if (system_.modes().contacts[contact].friction == Friction::none) return;
  const int count = count_signed_loads(system_.model(), contact);
  for (int k = 0; k < count; ++k) functions_.push_back({.contact = contact, .kind = Kind::load, .bearing = k});
}

// Sets the side on which bearings press: the present one, or the other one if the load has just passed through 0.
void EventLocation::choose_sides(const std::map<Watched, EventFunction>& before) {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    EventFunction& function = functions_[k];
    if (function.kind != Kind::load) continue;
    const auto same = before.find(watched(function));
    const bool passed = same != before.end() && same->second.reported;
    function.side = passed ? -same->second.side : now_[k].f < 0 ? -1 : 1;
    now_[k].f *= function.side;
    function.noise = std::max(friction_noise(system_, scale_, function.contact), vanished_force * function.bound);
  }
}

// The force of an idle contact that nothing loads (blocks that stand side by side) is the round-off of the others', and
// so is that of a sliding contact which the least forces of its group leave without a load. Where nothing presses
// (discs that touch in free fall), so is every force.
void EventLocation::allow_for_round_off(const State& now) {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    EventFunction& function = functions_[k];
    if (is_shared_force(function)) {
      const double largest = system_.largest_load(function.group, own_force_ ? now.lambda : lambda_);
      function.little = std::max(function.little, vanished_force * largest);
    }
    const bool has_own_force = function.kind == Kind::idle || (function.kind == Kind::press && function.group < 0);
    if (has_own_force && now_[k].f <= function.little) function.noise = function.little;
  }
}

bool EventLocation::unloads(int group) const {
  return std::any_of(functions_.begin(), functions_.end(),
                     [group](const EventFunction& f) { return f.kind == Kind::unload && f.group == group; });
}

// By group.
std::vector<double> EventLocation::little_forces() {
  std::vector<double> little;
  for (const model::SharedRows& shared : system_.modes().shared) {
    std::vector<model::ContactDirection> all = shared.basis;
    all.insert(all.end(), shared.implied.begin(), shared.implied.end());
    little.push_back(force_noise(system_, scale_, all));
  }
  return little;
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

// [m], or [m/s] of a slip, at the system's point: the value alone of a function that has a slope.
double EventLocation::gap_or_slip(int k) {
  const int contact = functions_[k].contact;
  if (functions_[k].kind == Kind::slide)
    return system_.modes().contacts[std::size_t(contact)].direction.dot(system_.slip(contact));
  return (functions_[k].kind == Kind::leave ? -1 : 1) * system_.gap(contact);
}

// At the system's point.
bool EventLocation::lacks_direction(const EventFunction& function) {
  return function.kind == Kind::slide && system_.tangents(function.contact) > 1 &&
         system_.slip(function.contact).norm() < system_.modes().contacts[std::size_t(function.contact)].least_slip;
}

// A slip that stays below `least_slip` for many times the time in which its acceleration would pass it is held:
// friction whose direction is not resolved there acts as a stiff damper that other sticking contacts balance. At the
// system's point, the end of the step.
bool EventLocation::stalls(double h, const State& next, int k) {
  const EventFunction& function = functions_[std::size_t(k)];
  if (!lacks_direction(function)) return false;
  const double pushed = std::max(function.pushed, system_.slip_acceleration(function.contact, next.a).norm());
  return (function.undirected_for + h) * pushed >
         function.patience * system_.modes().contacts[std::size_t(function.contact)].least_slip;
}

void EventLocation::measure_undirected(double h, const State& next, EventFunction& function) {
  if (!lacks_direction(function)) {
    function.undirected_for = function.pushed = 0;
    return;
  }
  function.undirected_for += h;
  function.pushed = std::max(function.pushed, system_.slip_acceleration(function.contact, next.a).norm());
}

double EventLocation::force(EventFunction& function, double t, const Vec& lambda) {
  if (function.kind == Kind::idle) return -system_.spring_force(function.contact, lambda);
  if (function.kind == Kind::unload) {  // friction that holds exactly at its bound (equal blocks) leaves no spare load
    function.bound = system_.largest_load(function.group, lambda);
    return std::max(function.little, critical_force * function.bound) +
           system_.spare_load_as_springs(function.group, lambda);
  }
  const double N = system_.normal_force(function.contact, lambda);
  if (function.kind == Kind::load) {
    function.bound = N;
    return function.side * signed_loads(system_, function.contact, t, lambda)[std::size_t(function.bearing)];
  }
  if (function.kind == Kind::hold)
    function.bound = system_.model().contacts[function.contact].coulomb->static_coefficient() * N;
  return function.kind == Kind::press ? N : function.bound - system_.friction_force(function.contact, lambda).norm();
}

bool EventLocation::evaluate(const State& state, std::vector<Value>& values) {
  system_.move_to(state.t, state.q, state.v);
  values.resize(functions_.size());
  bool accelerated = false;
  for (std::size_t k = 0; k < functions_.size(); ++k) values[k] = value(int(k), state, accelerated);
  return accelerated;
}

void EventLocation::evaluate(const State& state, std::vector<Value>& values, numerics::BlockSigns& signs) {
  if (evaluate(state, values))
    system_.find_signs(signs);
  else
    signs.clear();
}

// The function at `state`, the system's point. `accelerated`: a_ and lambda_ have been solved at this point.
EventLocation::Value EventLocation::value(int k, const State& state, bool& accelerated) {
  const auto accelerate = [&] {
    if (!std::exchange(accelerated, true)) system_.accelerate({}, a_, lambda_);
  };
  EventFunction& function = functions_[std::size_t(k)];
  if (function.kind == Kind::slide) return slide(function.contact, state.a);
  if (function.kind == Kind::follow) {
    accelerate();
    return {function.little - system_.departure(function.group, a_), 0};
  }
  if (function.kind == Kind::lean) return {most_leverage - system_.leverage(function.group), 0};
  if (function.kind == Kind::span) return {function.little - system_.off_span(function.group), 0};
  if (!by_force(k)) {
    const double sign = function.kind == Kind::leave ? -1 : 1;
    return {gap_or_slip(k), sign * system_.gap_rate(function.contact)};
  }
  if (function.kind == Kind::hold && function.at_ends)
    return {scale_.of(function.contact).no_acceleration() - system_.slip_acceleration(function.contact, state.a).norm(),
            0};
  if (!own_force_) accelerate();
  return {force(function, state.t, own_force_ ? state.lambda : lambda_), 0};
}

}  // namespace trammel::simulate
