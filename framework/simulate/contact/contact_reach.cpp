#include "simulate/contact/contact_reach.hpp"

#include <algorithm>
#include <cmath>

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
// levers have the scene's length.
bool moves(model::AssembledSystem& system, const Scale& scale, int contact) {
  const Vec rest = Vec::Zero(system.sizes().nv);
  const double by = system.acceleration({contact, 0}, model::pseudo_random(rest.size(), 1, 0)) -
                    system.acceleration({contact, 0}, rest);
  return std::abs(by) > round_off_of_levers * std::min(1.0, scale.length()) + round_off_of_places * scale.resolution();
}

}  // namespace

void check_reach(model::AssembledSystem& system, const State& start, const scene::Value& root,
                 scene::Problems& problems) {
  const Vec still = Vec::Zero(start.v.size());
  Vec elsewhere;
  ContactScale scale(system.model());
  system.move_to(start.t, start.q, still);
  scale.take_all(system);
  for (int i = 0; i < int(system.model().contacts.size()); ++i) {
    if (system.model().contacts[std::size_t(i)].joint) continue;
    system.move_to(start.t, start.q, still);
    const double gap = system.gap(i);
    const Scale own = scale.of(i);
    bool reaches = moves(system, own, i);
    for (double seed = 1; seed < 3 && !reaches; ++seed)  // the point may be a dead centre
      for (const double far : {away, away * std::max(1.0, std::abs(gap))}) {
        system.retract(start.q, model::pseudo_random(start.v.size(), far, seed), elsewhere);
        system.move_to(start.t, elsewhere, still);
        reaches = reaches || moves(system, own, i);
      }
    const model::ContactEntry& contact = system.model().contacts[std::size_t(i)];
    const scene::Value* at = root.at_path("contacts." + contact.name);
    system.move_to(start.t, start.q, still);
    if (const double depth = system.all_behind_plane(i); depth > 0)
      problems.error((at ? *at : root)
                         .problem(fmt::format("all of bodies.{} starts {:.6g} m or more behind this plane: its normal "
                                              "points to the free side, does it face away?",
                                              system.model().bodies[std::size_t(contact.A.body)].name, depth)));
    if (reaches) continue;
    const bool one_body = contact.A.body >= 0 && contact.A.body == contact.B.body;
    problems.error((at ? *at : root)
                       .problem(fmt::format(
                           "these can never touch: {}, so no motion changes their gap of {:.6g} m",
                           one_body ? "both are on bodies." + system.model().bodies[std::size_t(contact.A.body)].name
                                    : std::string("neither is on a body that can be moved"),
                           gap)));
  }
  system.move_to(start.t, start.q, start.v);
}

}  // namespace trammel::simulate
