#include "simulate/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulate/redundancy.hpp"

#include "simulate/contact_scale.hpp"
#include "simulate/equilibrium.hpp"

namespace trammel::simulate {
namespace {

constexpr double tolerance = 1e-8;  // [m], [rad], [m/s], [rad/s]

bool project_position(model::AssembledSystem& system, State& s) {
  Vec zero = Vec::Zero(system.sizes().nv), dq, mu, q;
  const Vec no_force = Vec::Zero(system.sizes().nc);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 50; ++i) {
    system.move_to(s.t, s.q, s.v);
    const Vec g = system.g();
    const double now = g.norm();
    if (!std::isfinite(now)) return false;
    if (now < 1e-15 || (now < 1e-11 && now > 0.5 * before)) return true;
    before = now;
    system.factorise({1, 0, 0}, zero, no_force);
    if (!system.correct(zero, g, dq, mu)) return false;
    system.retract(s.q, dq, q);
    s.q = q;
  }
  return before < tolerance;
}

bool project_velocity(model::AssembledSystem& system, State& s) {
  Vec zero = Vec::Zero(system.sizes().nv), dv, mu;
  const Vec no_force = Vec::Zero(system.sizes().nc);
  for (int i = 0; i < 2; ++i) {
    system.move_to(s.t, s.q, s.v);
    const Vec g_dot = system.g_dot();
    system.factorise({1, 0, 0}, zero, no_force);
    if (!system.correct(zero, g_dot, dv, mu)) return false;
    s.v += dv;
  }
  system.move_to(s.t, s.q, s.v);
  return system.g_dot().norm() < tolerance * std::max(1.0, s.v.norm());
}

// "bodies.rod moves by up to 0.012" for each body that the projection moves.
std::string moves(model::AssembledSystem& system, const State& from, const State& to) {
  Vec dq;
  system.difference(to.q, from.q, dq);
  std::string text;
  for (const model::BodyEntry& body : system.model().bodies) {
    if (body.nv == 0) continue;
    const double by = dq.segment(body.v0, body.nv).cwiseAbs().maxCoeff();
    const double rate = (to.v - from.v).segment(body.v0, body.nv).cwiseAbs().maxCoeff();
    if (by <= 0 && rate <= 0) continue;
    text += fmt::format("{}bodies.{} by up to {:.3g} (m, rad) and {:.3g} (m/s, rad/s)", text.empty() ? "" : ", ",
                        body.name, by, rate);
  }
  return text;
}

// Why no consistent state was found, and which joints and bodies are to blame.
std::string contradiction(model::AssembledSystem& system, const State& start) {
  const std::vector<std::string> paths = smallest_conflict(system, start);
  if (paths.empty())
    return "no consistent initial state was found nearby: the joints contradict each other, or the bodies are far off";
  if (paths.size() == 1)
    return fmt::format("no consistent initial state was found nearby: {} alone cannot hold from there", paths[0]);
  return fmt::format(
      "no consistent initial state was found nearby: {} contradict each other; without any one of them the rest can "
      "hold",
      fmt::join(paths, ", "));
}

// Rows that hold as they are, and still ask for accelerations that no motion has.
void check_motion(model::AssembledSystem& system, const State& s, const scene::Value& root, scene::Problems& problems) {
  Vec a, lambda, missed;
  system.move_to(s.t, s.q, s.v);
  try {
    system.accelerate({}, a, lambda);
  } catch (const model::NotSolvable&) {
    return;  // the run's own first solution says so, with its time
  }
  system.constraint_acceleration(a, missed);
  if (missed.norm() <= 1e-6 * std::max(1.0, a.norm())) return;
  const std::vector<std::string> paths = smallest_conflict(system, s);
  if (!paths.empty())
    problems.error(
        root.problem(fmt::format("{} hold at the start but prescribe motions that contradict each other; without any "
                                 "one of them the rest can hold",
                                 fmt::join(paths, ", "))));
}

void check_rows(model::AssembledSystem& system, const State& s, const scene::Value& root, scene::Problems& problems) {
  system.move_to(s.t, s.q, s.v);
  const Vec g = system.g(), g_dot = system.g_dot();
  State nearest = s;
  bool wrong = false;
  for (const model::RowGroup& rows : row_groups(system.model())) {
    const double position = g.segment(rows.first, rows.count).norm(),
                 velocity = g_dot.segment(rows.first, rows.count).norm();
    if (position <= tolerance && velocity <= tolerance * std::max(1.0, s.v.norm())) continue;
    const scene::Value* at = root.at_path(rows.path);
    problems.error(
        (at ? *at : root)
            .problem(fmt::format("the initial state does not satisfy this {}: off by {:.6g} (m, rad) in "
                                 "position and {:.6g} (m/s, rad/s) in velocity",
                                 rows.path.starts_with("joints.") ? "joint" : "body's own rows", position, velocity)));
    wrong = true;
  }
  if (!wrong) return;
  const bool found = project_position(system, nearest) && project_velocity(system, nearest);
  problems.error(root.problem(
      found
          ? fmt::format(
                "the nearest consistent initial state moves {}; \"initial\": {{\"consistent\": \"project\"}} takes it",
                moves(system, s, nearest))
          : contradiction(system, s)));
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
      problems.error(root.problem(contradiction(system, s)));
    if (problems.empty()) check_motion(system, s, root, problems);
  }
  if (wanted == Settings::Initial::equilibrium && problems.empty())
    if (const auto why = find_equilibrium(system, s))
      problems.error((root.find("initial") ? *root.find("initial") : root).problem(*why));
  system.move_to(t, s.q, s.v);
  ContactScale scale;
  scale.take_all(system);
  for (int i = 0; i < int(system.model().contacts.size()); ++i) {
    if (system.model().contacts[i].force) continue;  // compliant: it starts under load
    const double gap = system.gap(i);
    const scene::Value* at = root.at_path("contacts." + system.model().contacts[i].name);
    if (gap >= -scale.written_length()) continue;
    const auto& limit = system.model().contacts[i].limit;
    problems.error(
        (at ? *at : root)
            .problem(
                limit ? fmt::format("the initial state has passed the value that this contact waits for by {:.6g} "
                                    "(m, rad); expected a start {} it, or \"from\": \"{}\"",
                                    -gap, limit->side > 0 ? "above" : "below", limit->side > 0 ? "below" : "above")
                      : fmt::format("the initial state penetrates the plane by {:.6g} m; expected a gap >= 0", -gap)));
  }
  return s;
}

}  // namespace trammel::simulate
