#include "simulate/event/grazes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "simulate/event/thresholds.hpp"

namespace trammel::simulate {
namespace {

constexpr double part_of_drifts = 2;  // of the largest drift in a closed gap: an open gap is known no better

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

}  // namespace trammel::simulate
