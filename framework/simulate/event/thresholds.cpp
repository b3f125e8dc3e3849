#include "simulate/event/thresholds.hpp"

#include <algorithm>
#include <cmath>

#include "linear/dense/eps.hpp"
#include "simulate/contact/force_noise.hpp"

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;

// A part of a row that does not follow from those with which its contact shares: contacts that touched at one point
// have moved apart. It exceeds `no_share` (complementarity/shares/row_basis.cpp), so the other rows on which it depends
// show.
constexpr double most_off_span = 5e-9;
// Of `least_acceleration`: an implied direction that accelerates no more than this is still held.
constexpr double held_acceleration = 10;

// By group.
std::vector<double> little_forces(model::AssembledSystem& system, const ContactScale& scale) {
  std::vector<double> little;
  for (const model::SharedRows& shared : system.modes().shared) {
    std::vector<model::ContactDirection> all = shared.basis;
    all.insert(all.end(), shared.implied.begin(), shared.implied.end());
    little.push_back(force_noise(system, scale, all));
  }
  return little;
}

// Of a compliant contact that only touches: its depth is round-off, and so is its force.
double little_friction(const model::AssembledSystem& system, const ContactScale& scale, int contact) {
  const model::ContactEntry& entry = system.model().contacts[std::size_t(contact)];
  if (!entry.force || !entry.coulomb) return 0;
  const double approach = system.modes().contacts[std::size_t(contact)].approach_speed;
  return entry.coulomb->static_coefficient() * entry.force->normal(-scale.of(contact).touching(), 0, approach);
}

}  // namespace

void set_thresholds(std::vector<EventFunction>& functions, model::AssembledSystem& system, const ContactScale& scale,
                    const ContactModes& modes) {
  const std::vector<double> little = little_forces(system, scale);
  for (EventFunction& each : functions) {
    if (each.kind == Kind::unload || each.is_shared_force()) each.little = little[std::size_t(each.group)];
    if (each.kind == Kind::press && each.group < 0) each.little = force_noise(system, scale, {{each.contact, 0}});
    if (each.kind == Kind::follow) each.little = held_acceleration * modes.least_acceleration(each.contact);
    if (each.kind == Kind::span) each.little = std::max(most_off_span, 2 * system.off_span(each.group));
    if (each.kind == Kind::hold) each.little = little_friction(system, scale, each.contact);
  }
}

void allow_for_round_off(std::vector<EventFunction>& functions, model::AssembledSystem& system,
                         const ContactScale& scale, const Vec& forces) {
  for (EventFunction& each : functions) {
    if (each.is_shared_force())
      each.little = std::max(each.little, vanished_force * system.largest_load(each.group, forces));
    const bool has_own_force = each.kind == Kind::idle || (each.kind == Kind::press && each.group < 0);
    if (has_own_force && each.now.f <= each.little) each.noise = each.little;
    if (each.kind == Kind::load)
      each.noise = std::max(friction_noise(system, scale, each.contact), vanished_force * each.bound);
  }
}

void allow_for_friction_at_bounds(std::vector<EventFunction>& functions, model::AssembledSystem& system,
                                  const ContactScale& scale) {
  for (EventFunction& each : functions)
    if (each.kind == Kind::hold && !each.at_ends && each.now.f <= std::max(critical_force * each.bound, each.little))
      each.noise = std::max({each.noise, friction_noise(system, scale, each.contact), each.little});
}

double same_instant(const model::AssembledSystem& system, int contact, const Scale& scale) {
  const bool by_double_root = system.model().contacts[std::size_t(contact)].limit && system.redundant();
  return by_double_root ? std::sqrt(eps) * scale.length() : 4 * scale.touching();
}

}  // namespace trammel::simulate
