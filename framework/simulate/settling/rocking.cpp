#include "simulate/settling/rocking.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulate/contact/ending_impulses.hpp"

namespace trammel::simulate {

double Rocking::end(State& state, const BriefMotions& brief) {
  std::set<std::size_t> islands;  // of the scene
  for (std::size_t i = 0; i < touching_.size(); ++i)
    if (brief.falls[i] || brief.stops[i]) islands.insert(scene_.scale.island(touching_[i].contact));
  double taken = 0;
  for (const std::size_t island : islands) taken += end_of(island, state, brief);
  return taken;
}

// Separations may be too short to follow although their motion is not: a block that turns about its lower corner while
// the upper corner of the block below, nearly at the same point, parts from it. To end both rates takes away the whole
// motion; to end one makes the other one approach, so that its impact would restore them, without end. So the fastest
// rates go on, as few as let all others end without this.
double Rocking::end_of(std::size_t island, State& state, BriefMotions brief) {
  const std::vector<TouchingContact> after_impact = touching_;
  const Vec v_after_impact = state.v;
  do {
    const double taken = end_rates_of(island, state, brief);
    if (none_made_to_approach(island, after_impact)) return taken;
    touching_ = after_impact;
    state.v = v_after_impact;
    scene_.system.move_to(state.t, state.q, state.v);
  } while (leave_fastest(island, brief));
  return 0;
}

// Of contacts whose rows depend on each other, some keep the rate that another one would have to exceed (corners at one
// point, of bodies that turn against each other): these part.
double Rocking::end_rates_of(std::size_t island, State& state, const BriefMotions& brief) {
  const auto asked = [&](const TouchingContact& c) { return scene_.scale.island(c.contact) == island; };
  const auto rest_speed = [this](const TouchingContact& c) { return scene_.scale.of(c.contact).rest_speed(); };
  std::vector<bool> rests(touching_.size(), false);
  for (std::size_t i = 0; i < touching_.size(); ++i) {  // one whose slip stops may have a rate that steps left
    const TouchingContact& c = touching_[i];
    const bool rested = c.after <= rest_speed(c) || c.rests_as_before(rest_speed(c));
    rests[i] = asked(c) && (brief.falls[i] || brief.stops[i] || rested);
  }
  double taken = 0;
  for (bool any = true; any;) {
    taken += take_rates(state, rests, brief.stops);
    any = false;
    for (std::size_t i = 0; i < touching_.size(); ++i) {
      TouchingContact& c = touching_[i];
      if (!asked(c)) continue;
      const double left = scene_.system.gap_rate(c.contact);
      c.after = rests[i] && std::abs(left) <= scene_.scale.of(c.contact).left_by_impacts() ? 0 : left;
      if (!rests[i] && c.after < -rest_speed(c)) rests[i] = any = true;
    }
  }
  return taken;
}

bool Rocking::none_made_to_approach(std::size_t island, const std::vector<TouchingContact>& after_impact) const {
  return std::none_of(after_impact.begin(), after_impact.end(), [&](const TouchingContact& c) {
    const double least = -scene_.scale.of(c.contact).left_by_impacts();
    return scene_.scale.island(c.contact) == island &&
           scene_.system.gap_rate(c.contact) < std::min(c.after, 0.0) + least;
  });
}

// The fastest of the island's rates that were to end goes on; true if others are left to end.
bool Rocking::leave_fastest(std::size_t island, BriefMotions& brief) const {
  std::size_t fastest = 0, rates = 0;
  double largest = 0;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    const TouchingContact& c = touching_[i];
    if (scene_.scale.island(c.contact) != island || !(brief.falls[i] || brief.stops[i])) continue;
    ++rates;
    const double rate = std::max(brief.falls[i] ? c.after : 0, brief.stops[i] ? c.slip_after.norm() : 0);
    if (rate > largest) largest = rate, fastest = i;
  }
  if (rates < 2) return false;
  brief.falls[fastest] = brief.stops[fastest] = false;
  return true;
}

// The least change of v, so a loss of energy, after which the contacts in `rests` have no rate. The returned loss is
// the work of the impulses against the rates that they end; it does not include work of a moving base.
double Rocking::take_rates(State& state, const std::vector<bool>& rests, const std::vector<bool>& stops) {
  std::vector<model::ContactDirection> held;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    const TouchingContact& c = touching_[i];
    if (!rests[i]) continue;
    held.push_back({c.contact, 0});
    const bool sticks = stops[i] || c.slip_after.norm() <= scene_.scale.of(c.contact).rest_speed();
    if (scene_.system.model().contacts[c.contact].coulomb && sticks)
      for (int k = 1; k <= scene_.system.tangents(c.contact); ++k) held.push_back({c.contact, k});
  }
  Vec rates(Eigen::Index(held.size()));
  for (std::size_t i = 0; i < held.size(); ++i) rates[Eigen::Index(i)] = scene_.system.rate(held[i]);
  Mat jump, delassus;
  scene_.system.impulse_response(held, jump, delassus);
  const Vec impulses = ending_impulses(delassus, rates);
  state.v += jump * impulses;
  scene_.system.move_to(state.t, state.q, state.v);
  return -impulses.dot(rates + 0.5 * (delassus * impulses));
}

}  // namespace trammel::simulate
