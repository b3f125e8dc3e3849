// The contacts in their present modes: what the time loop asks about them between events.
#pragma once

#include "simulate/contact/contact_scene.hpp"

namespace trammel::simulate {

bool any_closed(const model::AssembledSystem& system);  // bearings of joints, which are always closed, do not count
bool any_rigid_closed(const model::AssembledSystem& system);
// [s] Longest controlled step that cannot pass over a double zero of a slip velocity: 0.45 of the shortest period in
// which a closed contact with set-valued friction swings back after a blow. Below half of the period a swing turns at
// most once within a step, so two zeros in it show in the slopes at its ends. (`find_dip` of event_search finds the
// zeros of c + cos in every phase up to 0.45, and misses the shallowest from 0.5 on.)
double longest_step_in_contact(model::AssembledSystem& system, const State& state);
// How near the forces of sliding contacts are to having no solution: the least pivot of their equations relative to
// that without friction; 0 at Painleve's critical state, 1 far from it.
double distance_from_critical(const ContactScene& scene, const State& state);
// Modes stay as they are, and so do all forces; contacts that share rows take the best conditioned basis. False:
// modes are to be decided (rule 13), since the others no longer hold an idle contact, or since a row has ceased to
// follow from others: its own force would hold what the contacts, which share a point no more, accelerate apart.
[[nodiscard]] bool renew_bases(const ContactScene& scene, State& state);
// Modes stay as they are, and nothing moves: other springs hold contacts at rest (rule 15). False: modes are to be
// decided, since none do.
[[nodiscard]] bool renew_springs(const ContactScene& scene, const State& state);
// After a step: springs of contacts that can be wedged in follow the loads at its end (rule 15).
void follow_loads(const ContactScene& scene, const State& state);

}  // namespace trammel::simulate
