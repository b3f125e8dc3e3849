#include "simulate/verdicts/held_at_bounds.hpp"

#include <algorithm>

#include "simulate/verdicts/errors_of_solutions.hpp"
#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;

std::vector<Participant*> HeldAtBounds::find(const State& state) {
  const auto at_bound = [this](const Participant& p) {
    const bool sticks = at_.modes.contacts[p.contact].friction == Friction::stick;
    return sticks && p.N > 0 && p.at_bound(p.let_go ? p.mu : p.mu_0);
  };
  if (at_.modes.shared.empty() || std::none_of(problem_.who.begin(), problem_.who.end(), at_bound)) return {};
  forces_.find(state);
  const std::vector<bool> moves = forces_.moves_as_found(), presses = forces_.presses_as_found();
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<Participant*> held;
  for (std::size_t g = 0; g < at_.modes.shared.size(); ++g) {
    const double round_off = round_off_of_loads * scene_.system.largest_load(int(g), forces_.lambda());
    const bool carries = scene_.system.spare_load(int(g), forces_.lambda()) >= -round_off;
    if (carries && !has_sliding(at_.modes.shared[g])) continue;
    for (std::size_t i = 0; i < island.size(); ++i) {
      Participant& p = problem_.who[i];
      if (carries && moves[island[i]] && presses[island[i]]) continue;
      if (at_bound(p) && shares_tangents(at_.modes.shared[g], p.contact)) held.push_back(&p);
    }
  }
  return held;
}

bool HeldAtBounds::let_go(const std::vector<Participant*>& held) {
  bool any = false;
  for (Participant* p : held)
    if (!p->let_go && p->mu < p->mu_0) p->let_go = any = true;
  return any;
}

void HeldAtBounds::keep(Participant& p) {
  model::ContactMode& mode = at_.modes.contacts[p.contact];
  mode.friction = Friction::slide;
  mode.direction = -direction_of(p.T);
  mode.least_slip = scene_.least_slip(p.contact);
  p.ratio = -p.mu * mode.direction;
}

}  // namespace trammel::simulate
