#include "simulate/event/earlier_events.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;

constexpr double new_spare_load = 1e-3;  // of the largest load: less may be left of the spare load that was just lost

const EventFunction* same_before(const EventFunction& function, const LastChange& change) {
  const auto same = change.before.find(function.watched());
  return same == change.before.end() ? nullptr : &same->second;
}

// After an event that left all contacts closed, sticking and sliding as they were. If others are idle now, or other
// springs press, a force or spare load that was 0 at the event is a new one. A function of a spare load begins at
// `little`.
bool shares_otherwise(const EventFunction& function, const LastChange& change) {
  if (function.kind == Kind::unload)
    return change.other_springs || function.now.f > function.little + new_spare_load * function.bound;
  return function.is_shared_force() && function.now.f > jumps_of_shares * function.little;
}

void wait_longer(EventFunction& function, const EventFunction& before, const LastChange& change, const Scale& scale) {
  const ValueAndSlope& now = function.now;
  if (function.kind == Kind::load || function.kind == Kind::span) return;
  if (function.kind == Kind::lean) {  // there is no better basis
    if (now.f < 0) function.noise = 2 * std::abs(now.f);
    return;
  }
  if (before.undirected.stalled) {  // its zero has not been seen: it slides on, and grows slowly
    function.undirected.patience = 4 * before.undirected.patience;
    function.noise = std::max(function.noise, before.noise);
    return;
  }
  function.undirected.patience = before.undirected.patience;
  if (function.kind == Kind::approach && now.slope > scale.left_by_impacts()) return;  // rebounds
  function.noise = std::max(function.noise, before.noise);
  if (now.f < 0 || (before.reported && (change.at_once || !shares_otherwise(function, change))))
    function.noise = std::max({function.noise, function.little, 2 * std::abs(now.f), 4 * before.noise});
}

}  // namespace

std::map<EventFunction::Watched, EventFunction> by_what_they_watch(const std::vector<EventFunction>& functions) {
  std::map<EventFunction::Watched, EventFunction> all;
  for (const EventFunction& each : functions) all.emplace(each.watched(), each);
  return all;
}

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

void choose_sides(std::vector<EventFunction>& functions, const LastChange& change) {
  for (EventFunction& function : functions) {
    if (function.kind != Kind::load) continue;
    const EventFunction* before = same_before(function, change);
    function.side = before && before->reported ? -before->side : function.now.f < 0 ? -1 : 1;
    function.now.f *= function.side;
  }
}

void keep_what_was_learnt(std::vector<EventFunction>& functions, const LastChange& change, const ContactScale& scale) {
  for (EventFunction& function : functions) {
    function.steepest = std::abs(function.now.slope);
    const EventFunction* before = same_before(function, change);
    if (!before) continue;
    if (function.kind == Kind::follow)  // a change of bases does not know the accelerations without forces
      function.little = std::max(function.little, before->little);
    wait_longer(function, *before, change, scale.of(function.contact));
  }
}

}  // namespace trammel::simulate
