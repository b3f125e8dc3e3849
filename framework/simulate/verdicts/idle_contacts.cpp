#include "simulate/verdicts/idle_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "complementarity/exact_modes.hpp"
#include "simulate/verdicts/errors_of_solutions.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;

namespace {

// Of the largest force in an island: less is none in an exact solution. Contacts with more may carry in the solution
// because their forces have just begun to grow. If some of them were idle, the others would share otherwise and move
// otherwise.
constexpr double no_force = 1e-12;

bool has_any(const std::vector<bool>& all) {
  return std::find(all.begin(), all.end(), true) != all.end();
}

}  // namespace

// Which contacts without a force are idle matters, because the springs' shares of the others affect the motion. The
// forces of the problem leave this open: they may be 0 by a self-stress that sliding contacts share, and their error is
// unknown where they are much larger than what accelerates (a wedge). So contacts with a little more force are idle
// too, or none is, if the forces in these modes could not be exerted otherwise. Each island is decided for itself: a
// force that is an error in one is large in another.
void IdleContacts::find_shares(const State& state) {
  Idle idle{.decided = at_.modes,
            .up_to = std::vector<double>(problem_.who.size(), complementarity::largest_violation)};
  share(idle);
  doubt(idle);
  fewer_idle(state, idle);
  more_idle(state, idle);
  if (!has_any(idle.doubtful)) return;
  constexpr double none_is = -1;
  share_doubtful(none_is, idle);
  if (doubts_remain(state, idle)) share_doubtful(complementarity::largest_violation, idle);
}

// Islands that move otherwise than found: only contacts without any force are idle.
void IdleContacts::fewer_idle(const State& state, Idle& idle) {
  if (!has_any(idle.doubtful) || !forces_.exist(state)) return;
  const std::vector<bool> as_found = forces_.moves_as_found();
  bool more = false;
  for (std::size_t k = 0; k < as_found.size(); ++k)
    if (idle.doubtful[k] && !as_found[k]) idle.up_to[k] = no_force, more = true;
  if (!more) return;
  share(idle);
  doubt(idle);
}

// Islands whose forces could not be exerted: the contact with the least force is idle too, as long as that may be an
// error.
void IdleContacts::more_idle(const State& state, Idle& idle) {
  while (doubts_remain(state, idle)) {
    bool more = false;
    for (std::size_t k = 0; k < idle.up_to.size(); ++k)
      if (idle.doubtful[k] && idle.least[k] <= most_error_of_forces) idle.up_to[k] = idle.least[k], more = true;
    if (!more) return;
    share(idle);
  }
}

bool IdleContacts::doubts_remain(const State& state, Idle& idle) {
  if (!has_any(idle.doubtful)) return false;
  const std::vector<bool> exerted = forces_.can_be_exerted(state);
  for (std::size_t k = 0; k < exerted.size(); ++k) idle.doubtful[k] = idle.doubtful[k] && !exerted[k];
  return has_any(idle.doubtful);
}

void IdleContacts::share_doubtful(double up_to, Idle& idle) {
  for (std::size_t k = 0; k < idle.up_to.size(); ++k)
    if (idle.doubtful[k]) idle.up_to[k] = up_to;
  share(idle);
}

void IdleContacts::share(Idle& idle) {
  at_.modes = idle.decided;
  idle.least = share(idle.up_to);
}

// Where contacts are idle, or others have forces that may be errors.
void IdleContacts::doubt(Idle& idle) const {
  idle.doubtful.assign(idle.up_to.size(), false);
  for (std::size_t k = 0; k < idle.least.size(); ++k) idle.doubtful[k] = idle.least[k] <= most_error_of_forces;
  const std::vector<std::size_t> island = problem_.islands();
  for (std::size_t i = 0; i < island.size(); ++i)
    if (problem_.who[i].idle) idle.doubtful[island[i]] = true;
}

std::vector<double> IdleContacts::share(const std::vector<double>& none) {
  const std::vector<double> least = problem_.find_idle(at_.modes, none);
  for (const Participant& p : problem_.who)  // without a force there is no friction
    if (model::ContactMode& mode = at_.modes.contacts[p.contact]; p.idle && mode.friction == Friction::stick)
      mode.friction = Friction::none;
  at_.modes.shared = problem_.shared_rows(at_.modes);
  while (open_loose_ones()) at_.modes.shared = problem_.shared_rows(at_.modes);
  return least;
}

// A contact without a force stays closed only as long as the others hold it.
bool IdleContacts::open_loose_ones() {
  const std::vector<bool> held = problem_.held_by_others(at_.modes);
  bool any = false;
  for (std::size_t i = 0; i < held.size(); ++i) {
    Participant& p = problem_.who[i];
    if (!p.idle || held[i]) continue;
    model::ContactMode& mode = at_.modes.contacts[p.contact];
    p.idle = mode.closed = false;
    mode.friction = Friction::none;
    any = true;
  }
  return any;
}

void IdleContacts::open_pulling_ones(const State& state) {
  const std::vector<double> largest = problem_.largest_in_island();
  std::vector<std::size_t> faint;
  for (std::size_t i = 0; i < largest.size(); ++i)
    if (const Participant& p = problem_.who[i];
        p.unilateral && !p.idle && p.N > 0 && p.N <= most_error_of_forces * largest[i])
      faint.push_back(i);
  if (faint.empty() || !forces_.exist(state)) return;
  const model::Modes decided = at_.modes;
  const auto contact = [this](std::size_t i) { return problem_.who[i].contact; };
  std::erase_if(faint, [&](std::size_t i) {
    return scene_.locks(contact(i)) || !(scene_.system.normal_force(contact(i), forces_.lambda()) < 0);
  });
  const std::vector<std::size_t> island = problem_.islands();
  for (std::vector<std::size_t>& opened = faint; !opened.empty();) {
    for (const std::size_t i : opened) {
      at_.modes.contacts[contact(i)].closed = false;
      at_.modes.contacts[contact(i)].friction = Friction::none;
    }
    find_shares(state);
    std::vector<bool> closes(problem_.who.size(), !forces_.exist(state));  // by island
    for (const std::size_t i : opened)
      if (!closes[island[i]] && !(scene_.system.acceleration({contact(i), 0}, forces_.a()) >= 0))
        closes[island[i]] = true;
    if (std::erase_if(opened, [&](std::size_t i) { return closes[island[i]]; }) == 0) return;
    at_.modes = decided;
    if (opened.empty()) find_shares(state);
  }
}

}  // namespace trammel::simulate
