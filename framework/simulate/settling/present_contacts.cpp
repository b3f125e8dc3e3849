#include "simulate/settling/present_contacts.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "simulate/decision/participants.hpp"
#include "simulate/verdicts/errors_of_solutions.hpp"
#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {
namespace {

// Of the shortest period of swings: the longest step.
constexpr double part_of_period = 0.45;
// Springs that hold under the present loads of joints change these loads, under which others may hold.
constexpr int most_rounds_of_springs = 10;

// The problem of the closed contacts in their present modes.
ContactProblem present_problem(const ContactScene& scene, const State& state) {
  scene.system.move_to(state.t, state.q, state.v);
  ContactsAtEvent at;
  at.before = at.modes = scene.system.modes();
  at.shared_before.assign(at.modes.contacts.size(), false);
  std::vector<int> candidates;
  for (int i = 0; i < int(at.modes.contacts.size()); ++i)
    if (at.modes.contacts[i].closed && scene.contact(i).restitution && !scene.locks(i)) candidates.push_back(i);
  ContactProblem problem;
  const ContactChanges none;
  problem.who = Participants(scene, at).gather(candidates, {state, none, false});
  for (Participant& p : problem.who) p.idle = scene.system.sharing(p.contact).idle;
  problem.prepare(scene.system);
  return problem;
}

bool same_springs(const std::vector<model::ContactMode>& one, const std::vector<model::ContactMode>& other) {
  const auto same = [](const model::ContactMode& a, const model::ContactMode& b) { return a.spring == b.spring; };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), same);
}

// With the loads that joints have under these springs.
bool springs_hold(model::AssembledSystem& system, const Vec& lambda) {
  for (int group = 0; group < int(system.modes().shared.size()); ++group) {
    const double round_off = round_off_of_loads * system.largest_load(group, lambda);
    if (!(system.spare_load_as_springs(group, lambda) >= -round_off)) return false;
  }
  return true;
}

// Under the present loads of joints. False: there are none, or they are the present ones.
bool find_other_springs(const ContactScene& scene, const State& state, const Vec& lambda) {
  model::Modes modes = scene.system.modes();
  for (int group = 0; group < int(modes.shared.size()); ++group) {
    const double round_off = round_off_of_loads * scene.system.largest_load(group, lambda);
    if (!take_springs(scene.system.find_springs(group, lambda, round_off), modes)) return false;
  }
  if (same_springs(modes.contacts, scene.system.modes().contacts)) return false;
  scene.system.set_modes(modes);
  scene.system.move_to(state.t, state.q, state.v);
  return true;
}

}  // namespace

bool any_closed(const model::AssembledSystem& system) {
  for (std::size_t i = 0; i < system.modes().contacts.size(); ++i)
    if (system.modes().contacts[i].closed && !system.model().contacts[i].joint) return true;
  return false;
}

bool any_rigid_closed(const model::AssembledSystem& system) {
  for (std::size_t i = 0; i < system.modes().contacts.size(); ++i)
    if (system.modes().contacts[i].closed && system.model().contacts[i].restitution) return true;
  return false;
}

double distance_from_critical(const ContactScene& scene, const State& state) {
  return present_problem(scene, state).distance_from_critical(scene.system.modes());
}

bool renew_bases(const ContactScene& scene, State& state) {
  const ContactProblem problem = present_problem(scene, state);
  model::Modes modes = scene.system.modes();
  const std::size_t implied_before = implied_rows(modes);
  const std::vector<bool> held = problem.held_by_others(modes);
  for (std::size_t i = 0; i < held.size(); ++i)
    if (problem.who[i].idle && !held[i]) return false;
  modes.shared = problem.shared_rows(modes);
  if (implied_rows(modes) < implied_before) return false;
  scene.system.set_modes(modes);
  scene.system.move_to(state.t, state.q, state.v);
  scene.system.accelerate({}, state.a, state.lambda);
  return true;
}

bool renew_springs(const ContactScene& scene, const State& state) {
  const model::Modes before = scene.system.modes();
  if (std::any_of(before.shared.begin(), before.shared.end(), has_sliding)) return false;
  for (int round = 0; round < most_rounds_of_springs; ++round) {
    Vec a, lambda;
    scene.system.move_to(state.t, state.q, state.v);
    scene.system.accelerate({}, a, lambda);
    if (!find_other_springs(scene, state, lambda)) break;
    if (springs_hold(scene.system, lambda)) return true;
  }
  scene.system.set_modes(before);
  return false;
}

void follow_loads(const ContactScene& scene, const State& state) {
  const auto wedged_in = [](const model::ContactMode& mode) { return mode.push.has_value(); };
  const std::vector<model::ContactMode>& present = scene.system.modes().contacts;
  if (std::none_of(present.begin(), present.end(), wedged_in)) return;
  model::Modes modes = scene.system.modes();
  Vec a, lambda;
  scene.system.move_to(state.t, state.q, state.v);
  scene.system.accelerate({}, a, lambda);
  for (int group = 0; group < int(modes.shared.size()); ++group) {
    if (has_sliding(modes.shared[std::size_t(group)])) continue;
    for (const auto& [contact, spring, push] : scene.system.find_springs(group, lambda, 0))
      if (push && wedged_in(modes.contacts[std::size_t(contact)])) modes.contacts[std::size_t(contact)].push = push;
  }
  scene.system.set_modes(modes);
  scene.system.move_to(state.t, state.q, state.v);
}

double longest_step_in_contact(model::AssembledSystem& system, const State& state) {
  std::vector<model::ContactDirection> directions;
  const auto& contacts = system.modes().contacts;
  for (int i = 0; i < int(contacts.size()); ++i)
    if (contacts[i].closed && contacts[i].friction != model::ContactMode::Friction::none)
      for (int row = 0; row <= system.tangents(i); ++row) directions.push_back({i, row});
  if (directions.empty()) return std::numeric_limits<double>::infinity();
  system.move_to(state.t, state.q, state.v);
  return part_of_period * 2 * std::numbers::pi / system.highest_frequency(directions);
}

}  // namespace trammel::simulate
