#include "simulate/watch/turn_counts.hpp"

#include <fmt/format.h>

#include <trammel/outside_domain.hpp>

#include "run/run_failed.hpp"

namespace trammel::simulate {

TurnCounts::TurnCounts(model::AssembledSystem& system) : system_(system) {
  for (const model::ForceEntry& entry : system.model().forces)
    if (auto* force = dynamic_cast<CountsTurns*>(entry.force.get()))
      counted_.push_back({"forces." + entry.name, "force_" + entry.name, entry.A, entry.B, force});
  for (const model::JointEntry& entry : system.model().joints)
    if (auto* joint = dynamic_cast<CountsTurns*>(entry.joint.get()))
      counted_.push_back({"joints." + entry.name, "joint_" + entry.name, entry.markers[0], entry.markers[1], joint});
}

void TurnCounts::follow(double t, const Vec& q, const Vec& v) {
  if (counted_.empty()) return;
  system_.move_to(t, q, v);
  for (const Counted& each : counted_) try {
      each.component->follow(system_.motion(each.A), system_.motion(each.B));
    } catch (const OutsideDomain& e) {
      throw RunFailed(fmt::format("at t = {:.9g} s: {}: {}", t, each.path, e.what()));
    }
}

void TurnCounts::archive(JsonArchive& a) {
  for (const Counted& each : counted_) {
    JsonArchive own = a.nested(each.key);
    each.component->archive(own);
  }
}

}  // namespace trammel::simulate
