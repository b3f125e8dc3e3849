#include "simulate/event/event_search.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;

constexpr double part_for_slopes = 1e-3;  // of the step: the difference in time that gives a force's slope
constexpr int most_probes = 6;
constexpr double near_zero = 0.25;     // of the values at the ends: a minimum below this may be a zero
constexpr double after_return = 1.25;  // of the time 2 u/|A| after which a gap closes again: it has closed by then

// Each slope of a force costs a solution of the equations of motion. It is worth it if the force is so small, compared
// with its change and the curvature of its last three values, that it could have crossed 0 and come back.
bool worth_slopes(const ExaminedStep& step, const EventFunction& function) {
  const double begin = function.now.f, change = function.next.f - begin;
  if (step.h_before == 0 && !function.inside) return true;
  // The second difference of a parabola through three values; in the first step the third one is inside the step.
  const double bend = step.h_before == 0
                          ? (*function.inside - begin - place_inside * change) * 2 / (place_inside * (1 - place_inside))
                          : change - (begin - function.before) * (step.h / step.h_before);
  return std::min(begin, function.next.f) < 0.5 * (std::abs(change) + std::abs(bend));
}

}  // namespace

std::optional<Suspect> find_dip(EventFunction& function, numerics::Cubic between, bool may_have_kink, double dt,
                                StepsFromNow& steps) {
  for (int probes = 0; probes < most_probes; ++probes) {
    const auto lowest = between.minimum();
    if (!lowest) return {};
    double at = lowest->at;
    if (!(lowest->f <= near_zero * std::min(between.at_low.f, between.at_high.f))) {
      const auto kink = may_have_kink ? between.kink_below_zero() : std::nullopt;
      if (!kink) return {};
      at = *kink;
    }
    ValueAndSlope there = steps.at(function, at);
    if (steps.happened(function, there)) return Suspect{&function, at, there};
    if (function.by_force()) there.slope = steps.force_slope(function, dt);
    if (there.slope < 0)
      between.low = at, between.at_low = there;
    else
      between.high = at, between.at_high = there;
  }
  return {};
}

std::optional<Suspect> find_return(EventFunction& function, double h, StepsFromNow& steps) {
  if (!function.is_gap() || !function.just_handled() || !(function.now.slope > 0)) return {};
  const double A = steps.gap_acceleration(function), at = -2 * after_return * function.now.slope / A;
  if (!(A < 0 && at < h)) return {};
  const ValueAndSlope there = steps.at(function, at);
  if (!steps.happened(function, there)) return {};
  return Suspect{&function, at, there};
}

EventSearch::Shown EventSearch::look(const ExaminedStep& step, std::span<EventFunction> functions) {
  Shown shown;
  for (EventFunction& function : functions) function.slope_now = function.slope_next = std::nullopt;
  for (std::size_t k = 0; k < functions.size(); ++k) {
    EventFunction& function = functions[k];
    std::optional<Suspect> suspect;
    if (function.at_ends) {
      if (fell(function)) shown.at_end.push_back(&function);
      continue;
    }
    if (steps_.happened(function, function.next)) suspect = Suspect{&function, step.h, function.next};
    if (!suspect) suspect = dip(step, functions.subspan(k));
    if (!suspect) suspect = find_return(function, step.h, steps_);
    if (suspect)
      shown.within.push_back(*suspect);
    else if (stalls(step, function))
      shown.at_end.push_back(&function);
  }
  return shown;
}

// Of a function judged at the ends of steps only.
bool EventSearch::fell(const EventFunction& function) const {
  if (function.kind == Kind::lean) return function.next.f < -function.noise;
  return function.next.f < 0 && (function.by_force() || function.next.slope < -steps_.scale(function).rest_speed());
}

bool EventSearch::stalls(const ExaminedStep& step, const EventFunction& function) {
  if (function.kind != Kind::slide) return false;
  system_.move_to(step.next.t, step.next.q, step.next.v);
  return function.undirected.stalls(system_, function.contact, step.h, step.next);
}

// Of the first of these functions.
std::optional<Suspect> EventSearch::dip(const ExaminedStep& step, std::span<EventFunction> functions) {
  EventFunction& function = functions.front();
  const bool force = function.by_force();
  numerics::Cubic between{0, step.h, function.now, function.next};
  if (between.at_high.f <= 0) return {};
  // Contacts may hold at the instant of an event, exactly at their bound, and not after it.
  if (force && function.just_handled() && between.at_high.f <= function.noise) return {};
  // A gap that falls faster than an impact may have left it closes at once, whatever it is at the end.
  const bool falls_at_once = function.is_gap() && between.at_low.slope < -steps_.scale(function).left_by_impacts();
  if (!force && function.just_handled() && between.at_low.slope <= 0 && !falls_at_once) return {};
  const double dt = part_for_slopes * step.h;
  if (force) {
    if (!worth_slopes(step, function)) return {};
    if (!function.slope_now) fill_slopes(step, functions, &EventFunction::slope_now, step.now, dt);
    if (!function.slope_next) fill_slopes(step, functions, &EventFunction::slope_next, step.next, -dt);
    between.at_low.slope = *function.slope_now, between.at_high.slope = *function.slope_next;
  }
  const bool may_have_kink = !force || system_.model().contacts[std::size_t(function.contact)].joint;
  return find_dip(function, between, may_have_kink, dt, steps_);
}

// Of all forces for which they are worth it.
void EventSearch::fill_slopes(const ExaminedStep& step, std::span<EventFunction> functions,
                              std::optional<double> EventFunction::*where, const State& state, double dt) {
  std::vector<EventFunction*> worth;
  for (EventFunction& each : functions)
    if (each.by_force() && !each.at_ends && worth_slopes(step, each)) worth.push_back(&each);
  const std::vector<double> slopes = values_.force_slopes(worth, state, dt);
  for (std::size_t i = 0; i < worth.size(); ++i) worth[i]->*where = slopes[i];
}

}  // namespace trammel::simulate
