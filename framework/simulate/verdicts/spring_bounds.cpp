#include "simulate/verdicts/spring_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/verdicts/errors_of_solutions.hpp"
#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {
namespace {

// Of the largest force in the island: bounds that differ by less are the same. In modes of an earlier round these do
// not depend on the bounds, and the forces may have errors.
constexpr double same_bound = 1e-9;
constexpr int most_rounds = 10;

bool same_modes(const model::Modes& one, const model::Modes& other) {
  return std::equal(one.contacts.begin(), one.contacts.end(), other.contacts.begin(), other.contacts.end(),
                    [](const auto& a, const auto& b) { return a.closed == b.closed && a.friction == b.friction; });
}

}  // namespace

// Of the contacts that share; the others have none.
void SpringBounds::take_springs_before() {
  for (model::ContactMode& mode : at_.modes.contacts) mode.spring = complementarity::Spring::undecided, mode.push = {};
  for (const model::SharedRows& group : at_.modes.shared) {
    const auto take = [&](const model::ContactDirection& d) {
      const model::ContactMode& before = at_.before.contacts[std::size_t(d.contact)];
      at_.modes.contacts[std::size_t(d.contact)].spring = before.spring;
      if (!has_sliding(group)) at_.modes.contacts[std::size_t(d.contact)].push = before.push;
    };
    std::for_each(group.basis.begin(), group.basis.end(), take);
    std::for_each(group.implied.begin(), group.implied.end(), take);
  }
}

// Out of sliding, with normal forces that are known.
bool SpringBounds::came_to_rest(const model::SharedRows& group) const {
  if (has_sliding(group)) return false;
  bool slid = false;
  for (const auto* directions : {&group.basis, &group.implied})
    for (const model::ContactDirection& d : *directions) {
      const model::ContactMode& before = at_.before.contacts[std::size_t(d.contact)];
      if (!at_.pressed_until_now(d.contact)) return false;
      slid = slid || (before.closed && before.friction == model::ContactMode::Friction::slide);
    }
  return slid;
}

// Springs are pushed as far as they were while their contacts slid. True if there are any such springs.
bool SpringBounds::take_springs_of_sliding() {
  Vec N(Eigen::Index(at_.modes.contacts.size()));
  for (int i = 0; i < int(N.size()); ++i) N[i] = at_.pressed_until_now(i).value_or(0);
  bool any = false;
  for (int g = 0; g < int(at_.modes.shared.size()); ++g) {
    if (!came_to_rest(at_.modes.shared[std::size_t(g)])) continue;
    const auto springs = system_.springs_pushed_by(g, forces_.lambda(), N);
    if (!springs.empty() && take_springs(springs, at_.modes)) any = true;
  }
  return any;
}

// By contact: what members of groups carry as springs, if such forces do not hold those at rest. `held` are at their
// bounds beside sliding ones (rule 12).
std::map<int, model::Carried> SpringBounds::carried_by_springs(const std::vector<Participant*>& held) {
  const auto decided_by_rule_12 = [&held](const model::SharedRows& group) {
    return has_sliding(group) && std::any_of(held.begin(), held.end(),
                                             [&](const Participant* p) { return shares_tangents(group, p->contact); });
  };
  std::map<int, model::Carried> carried;
  for (int g = 0; g < int(at_.modes.shared.size()); ++g) {
    if (decided_by_rule_12(at_.modes.shared[std::size_t(g)])) continue;
    const double round_off = round_off_of_loads * system_.largest_load(g, forces_.lambda());
    if (take_springs(system_.find_springs(g, forces_.lambda(), round_off), at_.modes)) continue;
    for (const model::Carried& each : system_.carried_as_springs(g, forces_.lambda())) carried[each.contact] = each;
  }
  return carried;
}

bool SpringBounds::bound_by_springs(const State& state, const std::vector<Participant*>& held) {
  const auto bounded = [](const Participant& p) { return p.pressed >= 0; };
  const bool any_bounded = std::any_of(problem_.who.begin(), problem_.who.end(), bounded);
  take_springs_before();
  if ((at_.modes.shared.empty() && !any_bounded) || !forces_.exist(state)) return false;
  if (take_springs_of_sliding()) forces_.find(state);
  if (!any_bounded) without_bounds_ = problem_.who;
  const std::map<int, model::Carried> carried = carried_by_springs(held);
  if (rounds_ > most_rounds) return false;  // rest stays by other forces: the springs of these groups are locked
  const std::vector<double> largest = problem_.largest_in_island();
  if (!any_bounded) modes_so_bounded_.clear();
  const bool again = std::any_of(modes_so_bounded_.begin(), modes_so_bounded_.end(),
                                 [this](const model::Modes& modes) { return same_modes(at_.modes, modes); });
  const double same = again ? most_error_of_forces : same_bound;
  modes_so_bounded_.push_back(at_.modes);
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
  if (changed && ++rounds_ > most_rounds) problem_.who = without_bounds_;
  return changed;
}

// Of a contact in the present modes, whose forces have been found.
model::Carried SpringBounds::carried_in_modes(int contact) {
  if (!at_.modes.contacts[std::size_t(contact)].closed) return {contact, 0, 0};
  return {contact, std::max(0.0, system_.normal_force(contact, forces_.lambda())),
          system_.friction_force(contact, forces_.lambda()).norm()};
}

}  // namespace trammel::simulate
