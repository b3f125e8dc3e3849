#include "simulate/turn_counts.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "simulate/run_failed.hpp"

namespace trammel::simulate {

TurnCounts::TurnCounts(model::AssembledSystem& system) : system_(system) {
  for (const model::ForceEntry& entry : system.model().forces)
    if (auto* force = dynamic_cast<CountsTurns*>(entry.force.get())) forces_.push_back({&entry, force});
}

void TurnCounts::follow(double t, const Vec& q, const Vec& v) {
  if (forces_.empty()) return;
  system_.move_to(t, q, v);
  for (const auto& [entry, force] : forces_) try {
      force->follow(system_.motion(entry->A), system_.motion(entry->B));
    } catch (const std::domain_error& e) {
      throw RunFailed(fmt::format("at t = {:.9g} s: forces.{}: {}", t, entry->name, e.what()));
    }
}

void TurnCounts::archive(JsonArchive& a) {
  for (const auto& [entry, force] : forces_) {
    JsonArchive own = a.nested("force_" + entry->name);
    force->archive(own);
  }
}

}  // namespace trammel::simulate
