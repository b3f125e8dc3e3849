#include "simulate/start/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnose/conflict.hpp"
#include "diagnose/row_offsets.hpp"
#include "run/contact_scale.hpp"
#include "run/row_tolerance.hpp"
#include "simulate/start/equilibrium.hpp"
#include "system/on_rows/onto_rows.hpp"

namespace trammel::simulate {
namespace {

// The metric of "nearest": the masses, and with contacts also the elastic energy at 1 rad/s, so that a beam that
// reaches into a plane is turned out of it and not bent.
constexpr Blend by_mass_and_stiffness = {1, 0, 1};

bool project_position(model::AssembledSystem& system, State& s, Blend nearest = model::by_mass) {
  return model::positions_onto_rows(system, s, {.metric = nearest, .allowed = row_tolerance(system, s).length});
}

bool project_velocity(model::AssembledSystem& system, State& s) {
  if (!model::velocities_onto_rows(system, s)) return false;
  const double allowed = row_tolerance(system, s).speed;
  system.move_to(s.t, s.q, s.v);
  return system.g_dot().norm() < allowed;
}

// Contacts with rows whose gap is negative by more than the digits of a scene.
std::vector<int> penetrated(model::AssembledSystem& system, const State& s) {
  system.move_to(s.t, s.q, s.v);
  ContactScale scale(system.model());
  scale.take_all(system);
  std::vector<int> all;
  for (int i = 0; i < int(system.model().contacts.size()); ++i) {
    if (system.model().contacts[i].force) continue;  // compliant: it starts under load
    if (system.gap(i) < -scale.of(i).written_length()) all.push_back(i);
  }
  return all;
}

// Moves the state to the nearest one in which the penetrating contacts touch and the joints' rows are satisfied.
// Contacts that penetrate then are added, so this ends. False: no such state was found.
bool project_out_of_contacts(model::AssembledSystem& system, State& s) {
  const model::Modes before = system.modes();
  model::Modes touching = before;
  bool found = true;
  for (std::vector<int> wrong = penetrated(system, s); found && !wrong.empty(); wrong = penetrated(system, s)) {
    bool more = false;
    for (const int i : wrong) more = more || !touching.contacts[std::size_t(i)].closed;
    for (const int i : wrong) touching.contacts[std::size_t(i)].closed = true;
    system.set_modes(touching);
    found = more && project_position(system, s, by_mass_and_stiffness);
    system.set_modes(before);
  }
  return found && (system.sizes().nc == 0 || project_velocity(system, s));
}

// Of the largest move: what the projection moves by less it moves by round-off.
constexpr double round_off_of_moves = 1e-12;

// "bodies.rod by up to 0.012 (m, rad) and 0 (m/s, rad/s)" for each body that the projection moves.
std::string moves(model::AssembledSystem& system, const State& from, const State& to) {
  Vec dq, dv = to.v - from.v;
  system.difference(to.q, from.q, dq);
  const double no_move = round_off_of_moves * dq.lpNorm<Eigen::Infinity>(),
               no_rate = round_off_of_moves * dv.lpNorm<Eigen::Infinity>();
  std::string text;
  for (const model::BodyEntry& body : system.model().bodies) {
    if (body.nv == 0) continue;
    const double by = dq.segment(body.v0, body.nv).cwiseAbs().maxCoeff();
    const double rate = dv.segment(body.v0, body.nv).cwiseAbs().maxCoeff();
    if (by <= no_move && rate <= no_rate) continue;
    text += fmt::format("{}bodies.{} by up to {:.3g} (m, rad) and {:.3g} (m/s, rad/s)", text.empty() ? "" : ", ",
                        body.name, by, rate);
  }
  return text;
}

// The problem, at the first joint or body of a conflict.
scene::Problem problem_at(const std::vector<std::string>& paths, const scene::Value& root, std::string message) {
  const scene::Value* at = paths.empty() ? nullptr : root.at_path(paths.front());
  return (at ? *at : root).problem(std::move(message));
}

// Why no consistent state was found, with the joints and bodies to blame.
scene::Problem contradiction(model::AssembledSystem& system, const State& start, const scene::Value& root) {
  const Conflict conflict = smallest_conflict(system, start);
  const std::vector<std::string>& paths = conflict.paths;
  const std::string none = "no consistent initial state was found nearby: ";
  const std::string either = "the joints contradict each other, or the bodies are far off";
  if (paths.empty()) return root.problem(none + either);
  if (paths.size() == 1)
    return problem_at(paths, root, none + (conflict.smallest ? "" : either + "; ") + description(conflict));
  return problem_at(paths, root, fmt::format("{}{} contradict each other{}", none, names(conflict), remark(conflict)));
}

void check_directions(model::AssembledSystem& system, const State& s, const scene::Value& root,
                      scene::Problems& problems) {
  system.move_to(s.t, s.q, s.v);
  for (const model::JointEntry& joint : system.model().joints)
    for (const int row : rows_without_direction(system, joint, s.t))
      problems.error(problem_at(
          {"joints." + joint.name}, root,
          fmt::format("row {} of {} has no direction at the start: no motion of the joint's markers changes it in "
                      "first order, as where markers coincide; place the markers apart, or leave the joint out",
                      row + 1, joint.rows)));
}

// Reports rows that are satisfied and still require accelerations that no motion has.
void check_motion(model::AssembledSystem& system, const State& s, const scene::Value& root, scene::Problems& problems) {
  Vec a, lambda, missed;
  system.move_to(s.t, s.q, s.v);
  try {
    system.accelerate({}, a, lambda);
  } catch (const model::NotSolvable&) {
    return;  // the run reports it at its first solution, with the time
  }
  system.constraint_acceleration(a, missed);
  const double off = missed.norm();
  if (off <= row_tolerance(system, s).missed_acceleration(a.norm())) return;
  const Conflict conflict = smallest_conflict(system, s);
  if (conflict.empty()) return;
  const std::string who = conflict.paths.size() > 1 ? names(conflict) : "joints",
                    why = conflict.paths.size() > 1 ? remark(conflict) : "; " + description(conflict);
  problems.error(
      problem_at(conflict.paths, root,
                 fmt::format("{} hold at the start but prescribe motions that contradict each other{}", who, why)));
}

void check_rows(model::AssembledSystem& system, const State& s, const scene::Value& root, scene::Problems& problems) {
  system.move_to(s.t, s.q, s.v);
  const Vec g = system.g(), g_dot = system.g_dot();
  const RowTolerance allowed = row_tolerance(system, s);
  system.move_to(s.t, s.q, s.v);
  State nearest = s;
  bool wrong = false;
  for (const model::RowGroup& rows : row_groups(system.model())) {
    const double position = g.segment(rows.first, rows.count).norm(),
                 velocity = g_dot.segment(rows.first, rows.count).norm();
    if (position <= allowed.length && velocity <= allowed.speed) continue;
    const Offset off = norm(row_offsets(system, rows, s));
    problems.error(problem_at(
        {rows.path}, root,
        fmt::format("the initial state does not satisfy this {}: off by {:.6g} (m, rad) in "
                    "position and {:.6g} (m/s, rad/s) in velocity",
                    rows.path.starts_with("joints.") ? "joint" : "body's own rows", off.position, off.velocity)));
    wrong = true;
  }
  if (!wrong) return;
  const bool found = project_position(system, nearest) && project_velocity(system, nearest);
  if (!found) return problems.error(contradiction(system, s, root));
  problems.error(root.problem(fmt::format(
      "the nearest consistent initial state moves {}; \"initial\": {{\"consistent\": \"project\"}} takes it",
      moves(system, s, nearest))));
}

void check_contacts(model::AssembledSystem& system, const State& s, const scene::Value& root,
                    scene::Problems& problems) {
  const std::vector<int> wrong = penetrated(system, s);
  for (const int i : wrong) {
    const model::ContactEntry& contact = system.model().contacts[std::size_t(i)];
    const scene::Value* at = root.at_path("contacts." + contact.name);
    const auto& limit = contact.limit;
    problems.error(
        (at ? *at : root)
            .problem(limit ? fmt::format("the initial state has passed the value that this contact waits for by {:.6g} "
                                         "(m, rad); expected a start {} it, or \"from\": \"{}\"",
                                         std::abs(row_offset(system, *limit, s.t).position),
                                         limit->side > 0 ? "above" : "below", limit->side > 0 ? "below" : "above")
                           : fmt::format("the initial state penetrates the plane by {:.6g} m; expected a gap >= 0",
                                         -system.gap(i))));
  }
  const bool latch = std::any_of(wrong.begin(), wrong.end(),
                                 [&](int i) { return system.model().contacts[std::size_t(i)].limit.has_value(); });
  State nearest = s;
  if (wrong.empty() || latch || !project_out_of_contacts(system, nearest)) return;
  problems.error(
      root.problem(fmt::format("the nearest initial state that touches moves {}; \"initial\": \"project\" takes it",
                               moves(system, s, nearest))));
}

}  // namespace

State initial_state(model::AssembledSystem& system, double t, Settings::Initial wanted, const scene::Value& root,
                    scene::Problems& problems) {
  State s;
  s.t = t;
  system.initial(s.q, s.v);
  model::Modes open;
  open.contacts.resize(system.model().contacts.size());
  system.set_modes(open);
  if (system.sizes().nc > 0) {
    if (wanted == Settings::Initial::check)
      check_rows(system, s, root, problems);
    else if (!project_position(system, s) || !project_velocity(system, s))
      problems.error(contradiction(system, s, root));
    if (problems.empty()) check_directions(system, s, root, problems);
    if (problems.empty()) check_motion(system, s, root, problems);
  }
  if (wanted == Settings::Initial::equilibrium && problems.empty())
    if (const auto why = find_equilibrium(system, s))
      problems.error((root.find("initial") ? *root.find("initial") : root).problem(*why));
  if (wanted == Settings::Initial::project && problems.empty() && !penetrated(system, s).empty() &&
      !project_out_of_contacts(system, s))
    problems.error(root.problem("no state was found nearby in which no contact penetrates"));
  if (problems.empty()) check_contacts(system, s, root, problems);
  return s;
}

}  // namespace trammel::simulate
