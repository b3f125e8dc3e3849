// Rules 12 to 15 of contact_mode.hpp: contacts that share their forces. Which of them have none and are idle, which
// open because the others do not hold them, and which are held at their bounds.
#include <algorithm>

#include "complementarity/exact_modes.hpp"
#include "simulate/settling/contact_mode.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

// Of the largest force in an island: less is none in an exact solution. Contacts with more may carry in the solution
// because their forces have just begun to grow. If some of them were idle, the others would share otherwise and move
// otherwise.
constexpr double no_force = 1e-12;
// Of the largest load of a group: a spare load may be negative by this round-off.
constexpr double round_off_of_loads = 1e-9;
// Rule 15. Of the largest force in the island: bounds that differ by less are the same. In the same modes these do not
// depend on the bounds, and the forces may have errors.
constexpr double same_bound = 1e-9;
constexpr int most_rounds_of_bounds = 10;

bool has_sliding(const model::SharedRows& group) {
  return !group.sliding.empty();
}

bool shares_tangents(const model::SharedRows& group, int contact) {
  const auto is = [contact](const model::ContactDirection& d) { return d.contact == contact && d.row > 0; };
  return std::any_of(group.basis.begin(), group.basis.end(), is) ||
         std::any_of(group.implied.begin(), group.implied.end(), is);
}

// Rule 12. Contacts held at their bounds let go where mu < mu_0. True if any does.
bool let_go(const std::vector<Participant*>& held) {
  bool any = false;
  for (Participant* p : held)
    if (!p->let_go && p->mu < p->mu_0) p->let_go = any = true;
  return any;
}

bool same_modes(const model::Modes& one, const model::Modes& other) {
  return std::equal(one.contacts.begin(), one.contacts.end(), other.contacts.begin(), other.contacts.end(),
                    [](const auto& a, const auto& b) { return a.closed == b.closed && a.friction == b.friction; });
}

bool has_any(const std::vector<bool>& all) {
  return std::find(all.begin(), all.end(), true) != all.end();
}

}  // namespace

// Rule 13. Which contacts without a force are idle matters, because the springs' shares of the others affect the
// motion. The forces of the problem leave this open: they may be 0 by a self-stress that sliding contacts share, and
// their error is unknown where they are much larger than what accelerates (a wedge). So contacts with a little more
// force are idle too, or none is, if the forces in these modes could not be exerted otherwise. Each island is decided
// for itself: a force that is an error in one is large in another.
void ContactModes::find_shares(const State& state) {
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
void ContactModes::fewer_idle(const State& state, Idle& idle) {
  if (!has_any(idle.doubtful) || !has_forces_in(at_.modes, state)) return;
  const std::vector<bool> as_found = moves_as_found();
  bool more = false;
  for (std::size_t k = 0; k < as_found.size(); ++k)
    if (idle.doubtful[k] && !as_found[k]) idle.up_to[k] = no_force, more = true;
  if (!more) return;
  share(idle);
  doubt(idle);
}

// Islands whose forces could not be exerted: the contact with the least force is idle too, as long as that may be an
// error.
void ContactModes::more_idle(const State& state, Idle& idle) {
  while (doubts_remain(state, idle)) {
    bool more = false;
    for (std::size_t k = 0; k < idle.up_to.size(); ++k)
      if (idle.doubtful[k] && idle.least[k] <= most_error_of_forces) idle.up_to[k] = idle.least[k], more = true;
    if (!more) return;
    share(idle);
  }
}

bool ContactModes::doubts_remain(const State& state, Idle& idle) {
  if (!has_any(idle.doubtful)) return false;
  const std::vector<bool> exerted = can_be_exerted(state);
  for (std::size_t k = 0; k < exerted.size(); ++k) idle.doubtful[k] = idle.doubtful[k] && !exerted[k];
  return has_any(idle.doubtful);
}

void ContactModes::share_doubtful(double up_to, Idle& idle) {
  for (std::size_t k = 0; k < idle.up_to.size(); ++k)
    if (idle.doubtful[k]) idle.up_to[k] = up_to;
  share(idle);
}

void ContactModes::share(Idle& idle) {
  at_.modes = idle.decided;
  idle.least = share(idle.up_to);
}

// Where contacts are idle, or others have forces that may be errors.
void ContactModes::doubt(Idle& idle) const {
  idle.doubtful.assign(idle.up_to.size(), false);
  for (std::size_t k = 0; k < idle.least.size(); ++k) idle.doubtful[k] = idle.least[k] <= most_error_of_forces;
  const std::vector<std::size_t> island = problem_.islands();
  for (std::size_t i = 0; i < island.size(); ++i)
    if (problem_.who[i].idle) idle.doubtful[island[i]] = true;
}

std::vector<double> ContactModes::share(const std::vector<double>& none) {
  const std::vector<double> least = problem_.find_idle(at_.modes, none);
  for (const Participant& p : problem_.who)  // without a force there is no friction
    if (model::ContactMode& mode = at_.modes.contacts[p.contact]; p.idle && mode.friction == Friction::stick)
      mode.friction = Friction::none;
  at_.modes.shared = problem_.shared_rows(at_.modes);
  while (open_loose_ones()) at_.modes.shared = problem_.shared_rows(at_.modes);
  return least;
}

// Rule 13. A contact without a force stays closed only as long as the others hold it.
bool ContactModes::open_loose_ones() {
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

// Rule 13. A contact whose force in the solution may be its error pulls if its row makes this force exact. It opens, if
// it parts then; the contacts of one island together.
void ContactModes::open_pulling_ones(const State& state) {
  const std::vector<double> largest = problem_.largest_in_island();
  std::vector<std::size_t> faint;
  for (std::size_t i = 0; i < largest.size(); ++i)
    if (const Participant& p = problem_.who[i];
        p.unilateral && !p.idle && p.N > 0 && p.N <= most_error_of_forces * largest[i])
      faint.push_back(i);
  if (faint.empty() || !has_forces_in(at_.modes, state)) return;
  const model::Modes decided = at_.modes;
  const auto contact = [this](std::size_t i) { return problem_.who[i].contact; };
  std::erase_if(faint, [&](std::size_t i) {
    return scene_.locks(contact(i)) || !(system_.normal_force(contact(i), lambda_) < 0);
  });
  const std::vector<std::size_t> island = problem_.islands();
  for (std::vector<std::size_t>& opened = faint; !opened.empty();) {
    for (const std::size_t i : opened) {
      at_.modes.contacts[contact(i)].closed = false;
      at_.modes.contacts[contact(i)].friction = Friction::none;
    }
    find_shares(state);
    std::vector<bool> closes(problem_.who.size(), !has_forces_in(at_.modes, state));  // by island
    for (const std::size_t i : opened)
      if (!closes[island[i]] && !(system_.acceleration({contact(i), 0}, a_) >= 0)) closes[island[i]] = true;
    if (std::erase_if(opened, [&](std::size_t i) { return closes[island[i]]; }) == 0) return;
    at_.modes = decided;
    if (opened.empty()) find_shares(state);
  }
}

// Sets a_ and lambda_. False if these modes have no finite forces, as where a joint locks itself: they are only tried.
bool ContactModes::has_forces_in(const model::Modes& modes, const State& state) try {
  system_.set_modes(modes);
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  return a_.allFinite() && lambda_.allFinite();
} catch (const model::LocksItself&) {
  return false;
}

// By island: whether the forces in these modes push and stay in their cones.
std::vector<bool> ContactModes::can_be_exerted(const State& state) {
  const std::vector<std::size_t> island = problem_.islands();
  if (!has_forces_in(at_.modes, state)) return std::vector<bool>(island.size(), false);
  std::vector<double> largest(island.size(), 0), worst(island.size(), 0);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    const model::ContactMode& mode = at_.modes.contacts[p.contact];
    if (!mode.closed || !p.unilateral) continue;
    const double N = system_.normal_force(p.contact, lambda_);
    double& most = worst[island[i]];
    largest[island[i]] = std::max(largest[island[i]], std::abs(N));
    most = std::max(most, -N);
    if (mode.friction != Friction::stick) continue;
    const double bound = system_.model().contacts[p.contact].coulomb->static_coefficient() * std::max(0.0, N);
    most = std::max(most, system_.friction_force(p.contact, lambda_).norm() - bound);
  }
  std::vector<bool> exerted;
  for (std::size_t k = 0; k < island.size(); ++k) exerted.push_back(worst[k] <= most_error_of_forces * largest[k]);
  return exerted;
}

// By island: whether its contacts accelerate in these modes, a_, as in the solution.
std::vector<bool> ContactModes::moves_as_found() const {
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> all(island.size(), true);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    double off = p.unilateral ? std::abs(system_.acceleration({p.contact, 0}, a_) - p.a_n) : 0;
    if (p.tangent != Participant::Tangent::none)
      off = std::max(off, (system_.slip_acceleration(p.contact, a_) - p.a_t).norm());
    const double nothing =
        std::max(p.nothing, complementarity::largest_violation * at_.largest[std::size_t(p.contact)]);
    if (!(off <= nothing)) all[island[i]] = false;
  }
  return all;
}

// By island, in these modes, whose multipliers are lambda_: the sliding contacts that press in the solution press.
std::vector<bool> ContactModes::presses_as_found() const {
  const std::vector<std::size_t> island = problem_.islands();
  const std::vector<double> largest = problem_.largest_in_island();
  std::vector<bool> all(island.size(), true);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    const double error = most_error_of_forces * largest[i];
    if (at_.modes.contacts[p.contact].friction != Friction::slide || p.idle || p.N <= error) continue;
    if (!(system_.normal_force(p.contact, lambda_) > error)) all[island[i]] = false;
  }
  return all;
}

// Rule 12: the contacts at rest whose friction is at its bound in a group that cannot carry its resultant, or whose
// sliding members move or press otherwise than in the solution.
std::vector<Participant*> ContactModes::held_at_bounds(const State& state) {
  const auto at_bound = [this](const Participant& p) {
    const bool sticks = at_.modes.contacts[p.contact].friction == Friction::stick;
    return sticks && p.N > 0 && p.at_bound(p.let_go ? p.mu : p.mu_0);
  };
  if (at_.modes.shared.empty() || std::none_of(problem_.who.begin(), problem_.who.end(), at_bound)) return {};
  system_.set_modes(at_.modes);
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  const std::vector<bool> moves = moves_as_found(), presses = presses_as_found();
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<Participant*> held;
  for (std::size_t g = 0; g < at_.modes.shared.size(); ++g) {
    const double round_off = round_off_of_loads * system_.largest_load(int(g), lambda_);
    const bool carries = system_.spare_load(int(g), lambda_) >= -round_off;
    if (carries && !has_sliding(at_.modes.shared[g])) continue;
    for (std::size_t i = 0; i < island.size(); ++i) {
      Participant& p = problem_.who[i];
      if (carries && moves[island[i]] && presses[island[i]]) continue;
      if (at_bound(p) && shares_tangents(at_.modes.shared[g], p.contact)) held.push_back(&p);
    }
  }
  return held;
}

// The contact keeps T = mu N, as if it slid.
void ContactModes::keep_at_bound(Participant& p) {
  model::ContactMode& mode = at_.modes.contacts[p.contact];
  mode.friction = Friction::slide;
  mode.direction = -direction_of(p.T);
  mode.least_slip = scene_.least_slip(p.contact);
  p.ratio = -p.mu * mode.direction;
}

// Rule 15. By contact: what members of groups carry as springs, if such forces do not hold those at rest. `held` are at
// their bounds beside sliding ones (rule 12).
std::map<int, model::Carried> ContactModes::carried_by_springs(const std::vector<Participant*>& held) {
  const auto decided_by_rule_12 = [&held](const model::SharedRows& group) {
    return has_sliding(group) && std::any_of(held.begin(), held.end(),
                                             [&](const Participant* p) { return shares_tangents(group, p->contact); });
  };
  std::map<int, model::Carried> carried;
  for (int g = 0; g < int(at_.modes.shared.size()); ++g) {
    if (decided_by_rule_12(at_.modes.shared[std::size_t(g)])) continue;
    const double round_off = round_off_of_loads * system_.largest_load(g, lambda_);
    if (system_.spare_load_as_springs(g, lambda_) >= -round_off) continue;
    for (const model::Carried& each : system_.carried_as_springs(g, lambda_)) carried[each.contact] = each;
  }
  return carried;
}

// Rule 15. True if the bounds of friction have changed: all modes are to be decided again. If the bounds come to no
// end, none is kept.
bool ContactModes::bound_by_springs(const State& state, const std::vector<Participant*>& held) {
  const auto bounded = [](const Participant& p) { return p.pressed >= 0; };
  const bool any_bounded = std::any_of(problem_.who.begin(), problem_.who.end(), bounded);
  if (rounds_of_bounds_ > most_rounds_of_bounds || (at_.modes.shared.empty() && !any_bounded)) return false;
  if (!has_forces_in(at_.modes, state)) return false;
  if (!any_bounded) without_bounds_ = problem_.who;
  const std::map<int, model::Carried> carried = carried_by_springs(held);
  const std::vector<double> largest = problem_.largest_in_island();
  const double same = any_bounded && same_modes(at_.modes, modes_so_bounded_) ? most_error_of_forces : same_bound;
  modes_so_bounded_ = at_.modes;
  bool changed = false;
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    Participant& p = problem_.who[i];
    const auto by_springs = carried.find(p.contact);
    if (!p.unilateral || p.tangent == Participant::Tangent::none) continue;
    if (!bounded(p) && by_springs == carried.end()) continue;
    const auto [contact, N, T] = by_springs != carried.end() ? by_springs->second : carried_in_modes(p.contact);
    if (bounded(p) && std::abs(N - p.pressed) <= same * largest[i]) continue;
    const bool rests = p.tangent == Participant::Tangent::resting;
    if (rests && T > (1 - Participant::near_bound) * (p.let_go ? p.mu : p.mu_0) * N) p.let_go = p.yielded = true;
    p.pressed = N;
    changed = true;
  }
  if (changed && ++rounds_of_bounds_ > most_rounds_of_bounds) problem_.who = without_bounds_;
  return changed;
}

// Of a contact in the present modes, whose multipliers are lambda_.
model::Carried ContactModes::carried_in_modes(int contact) {
  if (!at_.modes.contacts[std::size_t(contact)].closed) return {contact, 0, 0};
  return {contact, std::max(0.0, system_.normal_force(contact, lambda_)),
          system_.friction_force(contact, lambda_).norm()};
}

// Rules 12, 14 and 15. False if a contact lets go: all modes are to be decided again.
bool ContactModes::share_within_bounds(const State& state) {
  const std::vector<Participant*> held = held_at_bounds(state);
  if (bound_by_springs(state, held) || let_go(held)) return false;
  for (Participant* p : held) keep_at_bound(*p);
  if (!held.empty()) find_shares(state);
  share_forces_found(state);
  return true;
}

// Rule 14. Islands which it does not help keep what was decided.
void ContactModes::share_forces_found(const State& state) {
  if (std::none_of(at_.modes.shared.begin(), at_.modes.shared.end(), has_sliding)) return;
  std::vector<bool> asked = can_be_exerted(state);  // by island
  asked.flip();
  if (!has_any(asked)) return;
  const model::Modes decided = at_.modes;
  const std::vector<Participant> found = problem_.who;
  take_verdicts_found();
  const std::vector<bool> at_edge = problem_.take_fewest_forces(at_.modes, asked);
  for (std::size_t i = 0; i < at_edge.size(); ++i)
    if (Participant& p = problem_.who[i]; at_edge[i] && at_.modes.contacts[p.contact].friction != Friction::slide)
      keep_at_bound(p);
  share(std::vector<double>(problem_.who.size(), complementarity::largest_violation));
  const std::vector<bool> exerted = can_be_exerted(state);
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> helped(at_.modes.contacts.size(), false);  // by contact
  for (std::size_t i = 0; i < found.size(); ++i) {
    helped[std::size_t(found[i].contact)] = asked[island[i]] && exerted[island[i]];
    if (!helped[std::size_t(found[i].contact)]) problem_.who[i] = found[i];
  }
  keep_others(decided, helped, at_.modes);
}

}  // namespace trammel::simulate
