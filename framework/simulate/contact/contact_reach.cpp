#include "simulate/contact/contact_reach.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "run/contact_scale.hpp"
#include "system/point/pseudo_random.hpp"

namespace trammel::simulate {
namespace {

// [m] Changes of a gap's acceleration by unit accelerations: round-off of levers up to this length, 1 m at most, and
// of differences of places.
constexpr double round_off_of_levers = 1e-12, round_off_of_places = 16;  // the latter times their resolution
// [m or rad] A point that may be a dead centre is left by this, and by this times the gap.
constexpr double away = 0.1;

// Does a pseudo-random acceleration at the system's point change the gap's acceleration by more than round-off? The
// lengths of levers are those of the scene.
bool moves(model::AssembledSystem& system, const Scale& scale, int contact) {
  const Vec rest = Vec::Zero(system.sizes().nv);
  const double by = system.acceleration({contact, 0}, model::pseudo_random(rest.size(), 1, 0)) -
                    system.acceleration({contact, 0}, rest);
  return std::abs(by) > round_off_of_levers * std::min(1.0, scale.length()) + round_off_of_places * scale.resolution();
}

// Does some motion change the gap, at the start or near it? A start may be a dead centre.
bool can_change(model::AssembledSystem& system, const State& start, const Scale& scale, int contact, double gap) {
  const Vec still = Vec::Zero(start.v.size());
  if (moves(system, scale, contact)) return true;
  Vec elsewhere;
  for (const double seed : {1.0, 2.0})
    for (const double far : {away, away * std::max(1.0, std::abs(gap))}) {
      system.retract(start.q, model::pseudo_random(start.v.size(), far, seed), elsewhere);
      system.move_to(start.t, elsewhere, still);
      if (moves(system, scale, contact)) return true;
    }
  return false;
}

std::string behind_plane(const model::Model& model, const model::ContactEntry& contact, double depth) {
  return fmt::format(
      "all of bodies.{} starts {:.6g} m or more behind this plane: its normal points to the free side, does it face "
      "away?",
      model.bodies[std::size_t(contact.A.body)].name, depth);
}

std::string never_touch(const model::Model& model, const model::ContactEntry& contact, double gap) {
  const bool one_body = contact.A.body >= 0 && contact.A.body == contact.B.body;
  return fmt::format("these can never touch: {}, so no motion changes their gap of {:.6g} m",
                     one_body ? "both are on bodies." + model.bodies[std::size_t(contact.A.body)].name
                              : std::string("neither is on a body that can be moved"),
                     gap);
}

}  // namespace

void check_reach(model::AssembledSystem& system, const State& start, const scene::Value& root,
                 scene::Problems& problems) {
  const model::Model& model = system.model();
  const Vec still = Vec::Zero(start.v.size());
  ContactScale scale(model);
  system.move_to(start.t, start.q, still);
  scale.take_all(system);
  for (int i = 0; i < int(model.contacts.size()); ++i) {
    const model::ContactEntry& contact = model.contacts[std::size_t(i)];
    if (contact.joint) continue;
    const scene::Value* at = root.at_path("contacts." + contact.name);
    const auto report = [&](const std::string& text) { problems.error((at ? *at : root).problem(text)); };
    system.move_to(start.t, start.q, still);
    const double gap = system.gap(i);
    const bool reaches = can_change(system, start, scale.of(i), i, gap);
    system.move_to(start.t, start.q, still);
    if (const double depth = system.all_behind_plane(i); depth > 0) report(behind_plane(model, contact, depth));
    if (!reaches) report(never_touch(model, contact, gap));
  }
  system.move_to(start.t, start.q, start.v);
}

}  // namespace trammel::simulate
