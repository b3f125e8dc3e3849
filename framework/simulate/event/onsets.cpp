#include "simulate/event/onsets.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "simulate/event/thresholds.hpp"

namespace trammel::simulate {
namespace {

constexpr double part_of_drifts = 2;        // of the largest drift in a closed gap: an open gap is known no better
constexpr double largest_of_drifts = 1e-4;  // of the scene's length: larger gaps are not looked at

// Compliant contacts have no impact, and latches lock where they touch.
bool may_graze(const model::AssembledSystem& system, int contact) {
  const Restitution* law = system.model().contacts[std::size_t(contact)].restitution;
  return law && law->treatment().release != Restitution::Release::never;
}

// [m] By island: the largest gap of a closed rigid contact. At the system's point.
std::map<std::size_t, double> drifts_of_gaps(model::AssembledSystem& system, const ContactScale& scale) {
  std::map<std::size_t, double> drifts;
  for (int i = 0; i < int(system.model().contacts.size()); ++i) {
    if (!system.model().contacts[std::size_t(i)].restitution || !system.modes().contacts[std::size_t(i)].closed)
      continue;
    double& largest = drifts[scale.island(i)];
    largest = std::max(largest, std::abs(system.gap(i)));
  }
  return drifts;
}

bool is_onset(const EventFunction& function, const model::AssembledSystem& system) {
  return function.kind == EventFunction::Kind::approach && !function.at_ends && !function.grazed &&
         system.model().contacts[std::size_t(function.contact)].restitution;
}

// At the system's point.
bool take_out_drifts(model::AssembledSystem& system, const State& at, Vec& q) {
  const Vec zero = Vec::Zero(system.sizes().nv), no_force = Vec::Zero(system.sizes().nc);
  const Vec drifts = system.g();
  Vec change, multipliers;
  system.factorise({1, 0, 0}, zero, no_force, Factors::projection);
  if (!system.correct(zero, drifts, change, multipliers, Factors::projection)) return false;
  system.retract(at.q, change, q);
  return true;
}

}  // namespace

bool grazes(const ValueAndSlope& gap, double acceleration, double noise) {
  return gap.slope < 0 && acceleration > 0 && gap.f - gap.slope * gap.slope / (2 * acceleration) > -noise;
}

void mark_grazes(std::vector<EventFunction>& functions, model::AssembledSystem& system, const ContactScale& scale,
                 EventValues& values, const State& next) {
  const auto may_strike = [&](const EventFunction& function) {
    return function.kind == EventFunction::Kind::approach && !function.at_ends && function.next.slope < 0 &&
           function.next.f <= same_instant(system, function.contact, scale.of(function.contact)) &&
           may_graze(system, function.contact);
  };
  for (EventFunction& function : functions) function.grazed = false;
  if (std::none_of(functions.begin(), functions.end(), may_strike)) return;
  values.move_to(next);
  std::map<std::size_t, double> drifts = drifts_of_gaps(system, scale);
  for (EventFunction& function : functions) {
    if (!may_strike(function)) continue;
    const double known = std::max(function.noise, part_of_drifts * drifts[scale.island(function.contact)]);
    function.grazed = function.next.f <= known && grazes(function.next, values.gap_acceleration(function, next), known);
    if (function.grazed) function.noise = known;
  }
}

void mark_together(std::vector<EventFunction>& functions, const EventFunction& first, model::AssembledSystem& system,
                   const ContactScale& scale, const State& next) {
  const auto may_strike_too = [&](const EventFunction& function) {
    const Scale of_contact = scale.of(function.contact);
    return &function != &first && is_onset(function, system) && function.next.slope < -of_contact.rest_speed() &&
           scale.island(function.contact) == scale.island(first.contact) &&
           function.next.f <= largest_of_drifts * of_contact.length();
  };
  for (EventFunction& function : functions) function.together = false;
  if (!is_onset(first, system) || std::none_of(functions.begin(), functions.end(), may_strike_too)) return;
  system.move_to(next.t, next.q, next.v);
  if (Vec q; system.sizes().nc > 0 && take_out_drifts(system, next, q)) {
    system.move_to(next.t, q, next.v);
    const double late = system.gap(first.contact) / -system.gap_rate(first.contact);  // [s] after `next`
    for (EventFunction& function : functions) {
      if (!may_strike_too(function)) continue;
      const double left = system.gap(function.contact) + system.gap_rate(function.contact) * late;
      function.together = std::abs(left) <= same_instant(system, function.contact, scale.of(function.contact));
    }
  }
  system.move_to(next.t, next.q, next.v);
}

}  // namespace trammel::simulate
