#include "simulate/decision/what_follows.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

namespace {

// Parts of the time in which the scene crosses its length, at its speed or by
// its accelerations, or in which a slip ends; little else has changed by then. Each is tried if those before it leave
// the modes in doubt.
constexpr double moments_later[] = {1e-4, 1e-3, 1e-2};

}  // namespace

// [s] The time in which the contacts asked cross the length of their scene, or in which a slip ends if this is shorter.
// At the system's point; a are the accelerations there.
double WhatFollows::time_of_change(const std::vector<bool>& asked, const Vec& a) const {
  double length = 0, speed = 0, largest = 0;
  const auto is_asked = [&](const Participant& p) { return asked[std::size_t(p.contact)]; };
  for (const Participant& p : instant_.problem().who) {
    if (!is_asked(p)) continue;
    const Scale scale = scene_.scale.of(p.contact);
    length = std::max(length, scale.length()), speed = std::max(speed, scale.speed);
    largest = std::max(largest, at_.largest[std::size_t(p.contact)]);
  }
  speed = std::max(speed, std::sqrt(largest * length));
  double least = speed > 0 ? length / speed : 0;
  for (const Participant& p : instant_.problem().who) {
    if (p.tangent != Participant::Tangent::sliding || !is_asked(p)) continue;
    const Tangential slip = scene_.system.slip(p.contact), change = scene_.system.slip_acceleration(p.contact, a);
    if (!(slip.dot(change) < 0)) continue;  // it does not slow down
    const double slips = slip.norm();
    if (slips > scene_.scale.of(p.contact).rest_speed() && slips < least * change.norm()) least = slips / change.norm();
  }
  return least;
}

// Adds to the contacts asked all that share an island with one of them now: one that was released may press
// again.
std::vector<bool> WhatFollows::with_their_islands(std::vector<bool> asked) const {
  if (instant_.problem().who.empty()) return asked;
  const std::vector<std::size_t> island = instant_.problem().islands();
  std::vector<bool> of_island(island.size(), false);
  for (std::size_t i = 0; i < island.size(); ++i)
    if (asked[std::size_t(instant_.problem().who[i].contact)]) of_island[island[i]] = true;
  for (std::size_t i = 0; i < island.size(); ++i)
    if (of_island[island[i]]) asked[std::size_t(instant_.problem().who[i].contact)] = true;
  return asked;
}

complementarity::ContactSolution WhatFollows::decide(const State& state, ContactChanges changes, bool jumped,
                                                     const std::vector<bool>& asked,
                                                     complementarity::ContactSolution so_far) {
  const model::Modes decided = at_.modes;
  const std::vector<Participant> now =
      so_far.outcome == LcpOutcome::solved ? instant_.problem().who : std::vector<Participant>();
  scene_.system.set_modes(so_far.outcome == LcpOutcome::solved ? at_.modes : at_.before);
  scene_.system.move_to(state.t, state.q, state.v);
  Vec a, lambda;
  scene_.system.accelerate({}, a, lambda);
  const double time = time_of_change(asked, a);
  changes.released.clear();
  for (const double part : moments_later) {
    const double moment = part * time;
    State later = state;
    later.t += moment;
    scene_.system.retract(state.q, moment * state.v + 0.5 * moment * moment * a, later.q);
    later.v += moment * a;
    scene_.system.move_to(later.t, later.q, later.v);
    const complementarity::ContactSolution solution = instant_.decide(later, changes, jumped, now);
    scene_.system.move_to(state.t, state.q, state.v);
    if (solution.outcome == LcpOutcome::solved) keep_others(decided, with_their_islands(asked), at_.modes);
    if (solution.outcome != LcpOutcome::gave_up) return solution;
  }
  at_.modes = decided;
  return so_far;
}

}  // namespace trammel::simulate
