#include "simulate/verdicts/verdicts.hpp"

#include <algorithm>

#include "simulate/verdicts/errors_of_solutions.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;

double Verdicts::least_acceleration(const Participant& p) const {
  return std::max(p.nothing, undecided * p.violation * at_.largest[std::size_t(p.contact)]);
}

void Verdicts::take() {
  std::vector<double> nothing;
  for (const Participant& p : problem_.who) nothing.push_back(least_acceleration(p));
  const std::vector<bool> kept_closed = problem_.kept_closed(nothing);
  const std::vector<double> largest = problem_.largest_in_island();
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const Participant& p = problem_.who[i];
    const bool presses = p.N > 0 && !merely_touches(i, largest[i]);
    take(p, !p.unilateral || presses || kept_closed[i]);
  }
}

// Rule 3: it was open, its force may be round-off, and its gap would not close without this force. A larger force may
// be needed although it drives its own gap apart, by friction. `largest`: the largest force in its island.
bool Verdicts::merely_touches(std::size_t participant, double largest) const {
  const Participant& p = problem_.who[participant];
  return p.unilateral && !at_.before.contacts[p.contact].closed && p.N <= most_error_of_forces * largest &&
         would_hardly_close(participant);
}

bool Verdicts::would_hardly_close(std::size_t participant) const {
  return problem_.acceleration_without(participant) >= -undecided * least_acceleration(problem_.who[participant]);
}

void Verdicts::take(const Participant& p, bool closed) {
  model::ContactMode& mode = at_.modes.contacts[p.contact];
  mode.closed = closed;
  mode.friction = Friction::none;
  if (!mode.closed || p.tangent == Participant::Tangent::none || !scene_.system.model().contacts[p.contact].coulomb)
    return;
  mode.friction = Friction::slide;
  mode.direction = p.direction;
  mode.least_slip = scene_.least_slip(p.contact);
  if (p.tangent == Participant::Tangent::sliding) return;
  if (p.a_t.norm() > p.no_slip) {
    mode.direction = direction_of(p.a_t);
  } else if (p.yielded && p.at_bound(p.mu)) {  // slides, too slowly to be seen
    mode.direction = -direction_of(p.T);
  } else {
    mode.friction = Friction::stick;
    if (at_.before.contacts[p.contact].friction != Friction::stick) scene_.system.anchor(p.contact, mode);
  }
}

}  // namespace trammel::simulate
