#include "simulate/watch/last_motions.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace trammel::simulate {

namespace {

constexpr std::size_t named = 3;       // bodies
constexpr double worth_naming = 0.01;  // of the whole

}  // namespace

void LastMotions::take(double h) {
  std::shift_right(steps_.begin(), steps_.end(), 1);
  steps_[0] = h;
}

void LastMotions::take(const ContactEvent& event) {
  event_at_ = event.t, event_contact_ = event.contact, event_kind_ = int(event.kind);
}

std::string LastMotions::shares(model::AssembledSystem& system, const State& now, const State& next, double h) const {
  if (next.a.size() != now.a.size() || now.a.size() == 0 || !next.a.allFinite()) return "";
  const Vec dv = h * (next.a - now.a);
  Vec momentum = Vec::Zero(dv.size());
  system.move_to(now.t, now.q, now.v);
  system.add_mass_times(1, dv, momentum);
  const double all = dv.dot(momentum);
  if (!(all > 0)) return "";
  std::vector<std::pair<double, std::string>> bodies;
  for (const model::BodyEntry& body : system.model().bodies) {
    const double share = dv.segment(body.v0, body.nv).dot(momentum.segment(body.v0, body.nv)) / all;
    if (share > worth_naming) bodies.emplace_back(share, fmt::format("bodies.{} ({:.0f} %)", body.name, 100 * share));
  }
  std::stable_sort(bodies.begin(), bodies.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (bodies.size() > named) bodies.resize(named);
  std::vector<std::string> names;
  for (auto& [share, name] : bodies) names.push_back(std::move(name));
  return fmt::format("; in that step the velocities change most in {}, by energy", fmt::join(names, ", "));
}

std::string LastMotions::say(model::AssembledSystem& system, const State& now, const State& next, double h) const {
  std::string text = shares(system, now, next, h);
  std::vector<std::string> sizes;
  for (const double step : steps_)
    if (step > 0) sizes.push_back(fmt::format("{:.3g}", step));
  if (!sizes.empty()) text += fmt::format("; the steps before took {} s, the last one first", fmt::join(sizes, ", "));
  if (event_contact_ >= 0)
    text += fmt::format("; the last event is {} of {} at t = {:.9g} s", to_string(ContactEvent::Kind(event_kind_)),
                        system.model().contacts[std::size_t(event_contact_)].path(), event_at_);
  return text;
}

void LastMotions::archive(Archive& a) {
  a("last_step", steps_[0]), a("last_step_but_1", steps_[1]), a("last_step_but_2", steps_[2]);
  a("last_event_at", event_at_), a("last_event_contact", event_contact_), a("last_event_kind", event_kind_);
}

}  // namespace trammel::simulate
