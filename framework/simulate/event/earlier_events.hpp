// What event functions keep from those that watched the same before the last change.
//
// An event that changed nothing was round-off, or the missing force is too small to move anything yet. It is an event
// again when several times as much is missing. So was one that follows another of the same function after the shortest
// step: whatever the function was in between, it jumps there by its error.
#pragma once

#include <map>
#include <vector>

#include "run/contact_scale.hpp"
#include "simulate/event/event_function.hpp"
#include "system/point/contact_modes.hpp"

namespace trammel::simulate {

struct LastChange {
  std::map<EventFunction::Watched, EventFunction> before{};  // none if contacts have other modes now
  bool other_springs = false;                                // other springs hold contacts at rest
  bool at_once = false;                                      // it came the shortest step after the one before
};

std::map<EventFunction::Watched, EventFunction> by_what_they_watch(const std::vector<EventFunction>& functions);
// Whether contacts and friction have the same modes, and slips the same sense.
bool same_modes(const std::vector<model::ContactMode>& a, const std::vector<model::ContactMode>& b);
bool same_springs(const std::vector<model::ContactMode>& a, const std::vector<model::ContactMode>& b);

// Sets the side on which bearings press: the present one, or the other one if the load has just passed through 0.
void choose_sides(std::vector<EventFunction>& functions, const LastChange& change);
void keep_what_was_learnt(std::vector<EventFunction>& functions, const LastChange& change, const ContactScale& scale);

}  // namespace trammel::simulate
