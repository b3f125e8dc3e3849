#include "simulate/watch/last_motions.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace trammel::simulate {

namespace {

constexpr std::size_t named = 3;       // bodies, joints
constexpr double worth_naming = 0.01;  // of the whole
constexpr double round_off = 1e-12;    // of coordinates, in rows

std::vector<std::string> largest(std::vector<std::pair<double, std::string>> all) {
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (all.size() > named) all.resize(named);
  std::vector<std::string> names;
  for (auto& [size, name] : all) names.push_back(std::move(name));
  return names;
}

// Twice the kinetic energy of each coordinate of dv (nv), at the point of `system`: a measure that can add metres and
// radians.
Vec energies(model::AssembledSystem& system, const Vec& dv) {
  Vec momentum = Vec::Zero(dv.size());
  system.add_mass_times(1, dv, momentum);
  return dv.cwiseProduct(momentum);
}

// The sentence, with the bodies that have the largest parts of the sum (nv) inserted at its {}.
std::string made_by(fmt::format_string<std::string> sentence, const model::AssembledSystem& system, const Vec& parts) {
  const double all = parts.sum();
  std::vector<std::pair<double, std::string>> bodies;
  for (const model::BodyEntry& body : system.model().bodies) {
    const double share = parts.segment(body.v0, body.nv).sum() / all;
    if (share > worth_naming) bodies.emplace_back(share, fmt::format("bodies.{} ({:.0f} %)", body.name, 100 * share));
  }
  if (bodies.empty()) return "";
  return "; " + fmt::format(sentence, fmt::to_string(fmt::join(largest(bodies), ", ")));
}

}  // namespace

void LastMotions::take(double h) {
  std::shift_right(steps_.begin(), steps_.end(), 1);
  steps_[0] = h;
}

void LastMotions::take(const ContactEvent& event) {
  event_at_ = event.t, event_contact_ = event.contact, event_kind_ = int(event.kind);
}

std::string LastMotions::contributors(model::AssembledSystem& system, const LastTrial& trial) const {
  const auto& [now, next, h, error_parts, iterated] = trial;
  if (error_parts.size() > 0) return made_by("the error of the last trial is that of {}", system, error_parts);
  const bool tried = next.a.size() == system.sizes().nv && now.a.size() == next.a.size();  // empty at the start
  if (!tried || !next.q.allFinite() || !next.v.allFinite() || !next.a.allFinite()) return "";
  if (iterated) {
    State balanced = next;
    system.move_to(next.t, next.q, next.v);
    system.accelerate({}, balanced.a, balanced.lambda);
    return made_by("the residual of the last iterate is that of {}, by energy", system,
                   energies(system, h * (balanced.a - next.a)));
  }
  system.move_to(now.t, now.q, now.v);
  return made_by("in the last trial the velocities change most in {}, by energy", system,
                 energies(system, h * (next.a - now.a)));
}

std::string LastMotions::worst_rows(model::AssembledSystem& system, const State& next) const {
  if (system.sizes().nc == 0 || next.q.size() != system.sizes().nq || !next.q.allFinite()) return "";
  system.move_to(next.t, next.q, next.v);
  const Vec g = system.g();
  std::vector<std::pair<double, std::string>> groups;
  for (const model::RowGroup& rows : model::row_groups(system.model()))
    if (const double apart = rows.count > 0 ? g.segment(rows.first, rows.count).lpNorm<Eigen::Infinity>() : 0;
        apart > round_off * (1 + next.q.lpNorm<Eigen::Infinity>()))
      groups.emplace_back(apart, fmt::format("{} ({:.2g})", rows.path, apart));
  if (groups.empty()) return "";
  return fmt::format("; at the end of the last trial the rows farthest from 0 are those of {}",
                     fmt::join(largest(groups), ", "));
}

// By its present gap and rate; the motion may change them.
std::string LastMotions::next_closing(model::AssembledSystem& system, const State& now, double until) const {
  double soonest = until - now.t;
  int which = -1;
  system.move_to(now.t, now.q, now.v);
  for (int i = 0; i < int(system.model().contacts.size()); ++i) {
    if (system.model().contacts[std::size_t(i)].joint || system.modes().contacts[std::size_t(i)].closed) continue;
    const double gap = system.gap(i), rate = system.gap_rate(i);
    if (rate < 0 && gap > 0 && -gap / rate < soonest) soonest = -gap / rate, which = i;
  }
  if (which < 0) return "";
  return fmt::format("; {} may close next, at t = {:.9g} s by its gap of {:.3g} m and its rate",
                     system.model().contacts[std::size_t(which)].path(), now.t + soonest, system.gap(which));
}

std::string LastMotions::say(model::AssembledSystem& system, const LastTrial& trial, double until) const {
  std::string text = contributors(system, trial) + worst_rows(system, trial.next);
  std::vector<std::string> sizes;
  for (const double step : steps_)
    if (step > 0) sizes.push_back(fmt::format("{:.3g}", step));
  if (!sizes.empty()) text += fmt::format("; the steps before took {} s, the last one first", fmt::join(sizes, ", "));
  if (event_contact_ >= 0)
    text += fmt::format("; the last event is {} of {} at t = {:.9g} s", to_string(ContactEvent::Kind(event_kind_)),
                        system.model().contacts[std::size_t(event_contact_)].path(), event_at_);
  return text + next_closing(system, trial.now, until);
}

void LastMotions::archive(Archive& a) {
  a("last_step", steps_[0]), a("last_step_but_1", steps_[1]), a("last_step_but_2", steps_[2]);
  a("last_event_at", event_at_), a("last_event_contact", event_contact_), a("last_event_kind", event_kind_);
}

}  // namespace trammel::simulate
