#include "simulate/event_location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/root_bracket.hpp"

namespace trammel::simulate {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
// A rate nearer to 0 is the round-off of a separation or of a projection, not an approach.
constexpr double rate_noise = 1e-12;  // [m/s]

// Thrown and caught in this file: the integrator refused one of the steps that locate an event.
struct StepRefused {};

}  // namespace

// The cubic with values F and slopes S at both ends of [low, high] (Hermite); S_low < 0 < S_high, so it has one minimum.
struct EventLocation::Cubic {
  double low, high, F_low, F_high, S_low, S_high;
  struct Minimum {
    double at, value;
  };
  Minimum minimum() const {
    const double h = high - low, d = (F_high - F_low) / h;
    const double a = 3 * (S_low + S_high - 2 * d), b = 2 * (3 * d - 2 * S_low - S_high),
                 c = S_low;  // slope: a x^2 + b x + c
    const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
    const double x =
        std::clamp(b >= 0 ? -2 * c / (b + root) : (root - b) / (2 * a), 1e-3, 1 - 1e-3);  // where the slope rises
    const double value = F_low + h * x * (c + x * (b / 2 + x * a / 3));
    return {low + h * x, value};
  }
};

EventLocation::EventLocation(model::AssembledSystem& system, Integrator& integrator)
    : system_(system),
      integrator_(integrator),
      own_force_(!integrator.traits().holds_position && !integrator.traits().holds_velocity),
      now_(system.model().contacts.size()),
      next_(now_),
      probe_(now_),
      force_before_(now_.size()) {}

bool EventLocation::by_force(int i) const {
  return closed(i) && system_.model().contacts[i].restitution;
}

bool EventLocation::at_step_ends(int i) const {
  const Restitution* law = system_.model().contacts[i].restitution;
  return law && !closed(i) && law->treatment().onset == Restitution::Onset::next_step;
}

double EventLocation::watched(int i, const Values& values) const {
  if (by_force(i)) return values.force;
  return closed(i) ? -values.gap : values.gap;
}

double EventLocation::slope(int i, const Values& values) const {
  return closed(i) ? -values.rate : values.rate;
}

bool EventLocation::happened(int i, const Values& end) const {
  if (by_force(i)) return end.force < 0;
  return watched(i, end) < 0 && (slope(i, end) < -rate_noise || watched(i, now_[i]) > near_);
}

void EventLocation::evaluate(const State& state, std::vector<Values>& values) {
  system_.move_to(state.t, state.q, state.v);
  const Vec* lambda = nullptr;
  for (int i = 0; i < int(values.size()); ++i) {
    values[i].gap = system_.gap(i);
    values[i].rate = system_.gap_rate(i);
    values[i].force = 0;
    if (!by_force(i)) continue;
    if (!lambda) {
      lambda = own_force_ ? &state.lambda : &lambda_;
      if (!own_force_) system_.accelerate({}, a_, lambda_);
    }
    values[i].force = system_.normal_force(i, *lambda);
  }
}

void EventLocation::restart(const State& now) {
  if (!watches()) return;
  near_ = ContactModes::touching_gap(now);
  h_before_ = 0;
  evaluate(now, now_);
}

void EventLocation::accept(double h) {
  for (std::size_t i = 0; i < now_.size(); ++i) force_before_[i] = now_[i].force;
  h_before_ = h;
  now_.swap(next_);
}

const EventLocation::Values& EventLocation::step_to(const State& now, double h, int i) {
  ++steps_tried_;
  if (!integrator_.step(system_, now, h, trial_)) throw StepRefused{};
  evaluate(trial_, probe_);
  return probe_[i];
}

EventLocation::Found EventLocation::examine(const State& now, double& h, State& next) {
  evaluate(next, next_);
  suspects_.clear();
  at_end_.clear();
  changes_.clear();
  try {
    for (int i = 0; i < int(now_.size()); ++i) {
      Suspect suspect{i, h, watched(i, next_[i])};
      if (at_step_ends(i)) {
        if (next_[i].gap < 0 && next_[i].rate < -rate_noise) at_end_.push_back(i);
      } else if (happened(i, next_[i]) || dips(now, h, next, i, suspect)) {
        suspects_.push_back(suspect);
      }
    }
    if (suspects_.empty()) {
      if (at_end_.empty()) return Found::nothing;
      changes_.struck = at_end_;
      return Found::event;
    }
    double h_event = h;
    for (Suspect& suspect : suspects_) {
      if (suspect.high > h_event) {  // only if it comes before the earliest so far
        const Values& there = step_to(now, h_event, suspect.contact);
        if (!happened(suspect.contact, there)) continue;
        suspect.high = h_event, suspect.f_high = watched(suspect.contact, there);
      }
      h_event = std::min(h_event, locate(now, suspect));
    }
    h_event = std::min(h, std::max(h_event, 4 * eps * std::max(std::abs(now.t), std::abs(now.t + h))));
    if (h_event < h) {
      ++steps_tried_;
      if (!integrator_.step(system_, now, h_event, next)) return Found::step_refused;
      evaluate(next, next_);
      h = h_event;
    }
  } catch (const StepRefused&) {
    return Found::step_refused;
  }
  collect(next);
  return changes_.empty() ? Found::nothing : Found::event;
}

// What has happened at the end of the shortened step: the contact it was located for, and all others at the same instant.
void EventLocation::collect(const State& next) {
  const double same = std::max(near_, 4 * ContactModes::touching_gap(next));
  for (int i = 0; i < int(now_.size()); ++i) {
    if (by_force(i)) {
      if (next_[i].force <= 0) changes_.released.push_back(i);
      continue;
    }
    const bool compliant = !system_.model().contacts[i].restitution;
    if (at_step_ends(i) ? next_[i].gap < 0 && next_[i].rate < -rate_noise
                        : watched(i, next_[i]) <= same && slope(i, next_[i]) < -rate_noise)
      (compliant ? changes_.toggled : changes_.struck).push_back(i);
  }
}

double EventLocation::locate(const State& now, const Suspect& suspect) {
  const int i = suspect.contact;
  const double resolution = 2 * eps * std::max(std::abs(now.t), std::abs(now.t + suspect.high));
  numerics::RootBracket bracket{0, suspect.high, watched(i, now_[i]), suspect.f_high};
  if (bracket.f_low <= (by_force(i) ? 0 : near_)) {  // just separated: look for a moment when it was apart
    double apart = suspect.high;
    bool found = false;
    while (!found && apart > resolution) {
      apart /= 2;
      const Values& there = step_to(now, apart, i);
      const double f = watched(i, there);
      if (f > 0)
        bracket.low = apart, bracket.f_low = f, found = true;
      else if (happened(i, there))
        bracket.high = apart, bracket.f_high = f;
      else  // so near that nothing is to be seen yet: a step to there would find no event, and so without end
        break;
    }
    if (!found) return bracket.high;
  }
  if (bracket.f_high >= 0) return bracket.high;
  bracket = numerics::narrow([&](double h) { return watched(i, step_to(now, h, i)); }, bracket, resolution);
  return bracket.high;
}

// Whether the function, positive at both ends, is negative between them.
bool EventLocation::dips(const State& now, double h, const State& next, int i, Suspect& suspect) {
  const bool force = by_force(i);
  Cubic cubic{0, h, watched(i, now_[i]), watched(i, next_[i]), 0, 0};
  if (cubic.F_low <= (force ? 0 : near_) || cubic.F_high <= 0) return false;
  if (force) {
    if (!worth_slopes(i, h)) return false;
    cubic.S_low = force_slope(now, 1e-3 * h, i);
    cubic.S_high = force_slope(next, -1e-3 * h, i);
  } else {
    cubic.S_low = slope(i, now_[i]), cubic.S_high = slope(i, next_[i]);
  }
  for (int probes = 0; probes < 6; ++probes) {
    if (!(cubic.S_low < 0 && cubic.S_high > 0)) return false;
    const Cubic::Minimum minimum = cubic.minimum();
    if (minimum.value > 0.25 * std::min(cubic.F_low, cubic.F_high)) return false;
    const Values there = step_to(now, minimum.at, i);
    const double F = watched(i, there);
    if (F < 0) {
      suspect.high = minimum.at, suspect.f_high = F;
      return true;
    }
    const double S = force ? force_slope(trial_, 1e-3 * h, i) : slope(i, there);
    if (S < 0)
      cubic.low = minimum.at, cubic.F_low = F, cubic.S_low = S;
    else
      cubic.high = minimum.at, cubic.F_high = F, cubic.S_high = S;
  }
  return false;
}

// Slopes of the force cost a solution of the equations of motion each; they are asked for when the force is so small, compared
// with its change and the bend of its last three values, that it could have crossed 0 and come back.
bool EventLocation::worth_slopes(int i, double h) const {
  const double least = std::min(now_[i].force, next_[i].force), change = std::abs(next_[i].force - now_[i].force);
  if (h_before_ == 0) return true;
  const double bend = std::abs((next_[i].force - now_[i].force) - (now_[i].force - force_before_[i]) * (h / h_before_));
  return least < 0.5 * (change + bend);
}

double EventLocation::force_slope(const State& state, double dt, int i) {
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  const double force = system_.normal_force(i, lambda_);
  dq_ = dt * state.v + (0.5 * dt * dt) * state.a;
  system_.retract(state.q, dq_, moved_.q);
  moved_.v = state.v + dt * state.a;
  system_.move_to(state.t + dt, moved_.q, moved_.v);
  system_.accelerate({}, a_, lambda_);
  return (system_.normal_force(i, lambda_) - force) / dt;
}

void EventLocation::archive(Archive& a) {
  const auto n = Eigen::Index(now_.size());
  Mat values(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) values.row(i) << now_[i].gap, now_[i].rate, now_[i].force, force_before_[i];
  Vec flat = Eigen::Map<const Vec>(values.data(), values.size());
  a("watched", flat), a("h_before", h_before_), a("near", near_), a("steps_tried", steps_tried_);
  if (flat.size() != values.size()) return;  // of another scene: refused elsewhere
  for (Eigen::Index i = 0; i < n; ++i)
    now_[i] = {flat[i], flat[n + i], flat[2 * n + i]}, force_before_[i] = flat[3 * n + i];
}

}  // namespace trammel::simulate
