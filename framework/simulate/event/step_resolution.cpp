#include "simulate/event/step_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/contact/force_noise.hpp"

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;

// Irrational parts of a step, of the golden section, resonate with no period of a law.
constexpr double places[] = {place_inside, 0.7639320225002103, 0.1458980337503154};
constexpr double hides_nothing = 1e-6;  // of the longest step so far: shorter ones come from the location of events
constexpr double far_gap = 20;          // of the change of a gap in a step at its rate: a larger gap cannot close
constexpr double as_steep = 4;          // of the steepest slip so far: a steeper one is new
constexpr double off_cubic = 0.05;      // of a gap or slip: a larger departure from the cubic is more than its error
constexpr double could_cross = 4;       // of such a departure: values up to this may have been 0 in the step
constexpr double off_tangent = 0.5;     // of a force: a larger departure from its tangent
constexpr double most_lengthening = 5;  // of the last step, as in StepControl: the next one is no longer
constexpr double part_of_slip = 0.25;   // the most that a step may take from a slip at its steepest rate

// In space a slip is followed to its end by steps that leave at least `left_of_slip` of it. Near its zero the stiffness
// mu N/|s| across it is more than an explicit method can bear; round-off there would become a turn. Slips up to
// `nearly_least` times `least` may end within a step.
constexpr double left_of_slip = 0.2, nearly_least = 10;
bool overshoots(double begin, double end, double least) {
  return begin > nearly_least * least && end < left_of_slip * begin;
}

// True if swings within steps of length h could hide an event: of a force, or of a gap that is small for its rate.
bool swings_matter(const std::vector<EventFunction>& functions, ValueAndSlope EventFunction::*where, double h) {
  for (const EventFunction& function : functions) {
    if (function.at_ends || function.kind == Kind::slide) continue;
    if (function.by_force() || (function.*where).f < far_gap * h * std::abs((function.*where).slope)) return true;
  }
  return false;
}

}  // namespace

bool StepResolution::hides(const ExaminedStep& step, std::vector<EventFunction>& functions) {
  longest_ = std::max(longest_, step.h);
  if (step.h < hides_nothing * longest_) return false;
  bool motions = false, forces = false;
  for (const EventFunction& function : functions) {
    if (slip_hides(step, function)) return true;
    if (function.at_ends || function.of_rows()) continue;
    (function.by_force() ? forces : motions) = true;
  }
  if (step.h > between_states_.longest_resolved() &&
      (swings_matter(functions, &EventFunction::now, step.h) || swings_matter(functions, &EventFunction::next, step.h)))
    return true;
  return (motions && hides_motion(step, functions)) || (forces && hides_force(step, functions));
}

// True after a step past the end of a slip in space, or one longer than swings allow, in which a slip has become
// steeper than ever before.
bool StepResolution::slip_hides(const ExaminedStep& step, const EventFunction& f) {
  if (f.kind != Kind::slide) return false;
  const double least = system_.modes().contacts[std::size_t(f.contact)].least_slip, slope = std::abs(f.next.slope);
  if (system_.tangents(f.contact) > 1 && overshoots(f.now.f, f.next.f, least)) return true;
  return slope > as_steep * f.steepest && slope * step.h > f.now.f && f.now.f > f.noise;
}

// Compares gaps and slips within the step with the cubics between its ends. Where a base moves by a law of time they
// may swing within the step although the bodies do not, and the error estimate of the step does not show it.
bool StepResolution::hides_motion(const ExaminedStep& step, const std::vector<EventFunction>& functions) {
  for (const double place : places) {
    between_states_.at(step.now, step.next, place, between_);
    system_.move_to(between_.t, between_.q, between_.v);
    for (const EventFunction& function : functions) {
      if (function.at_ends || !function.has_slope()) continue;
      const double begin = function.now.f, end = function.next.f, there = values_.gap_or_slip(function);
      const double off = std::abs(there - numerics::Cubic{0, step.h, function.now, function.next}.value(place));
      if (off > off_cubic * std::max(std::abs(begin), std::abs(end)) &&
          could_cross * off > std::min({begin, end, there}) && off > resolution_of_motion(function))
        return true;
    }
  }
  return false;
}

// A difference of gaps [m] or slips [m/s] up to this is round-off.
double StepResolution::resolution_of_motion(const EventFunction& function) const {
  const Scale scale = scale_.of(function.contact);
  return function.kind == Kind::slide ? scale.drift() : scale.touching();
}

// Compares the force with its tangent of the step before; in the first step, with the line between its ends.
bool StepResolution::hides_force(const ExaminedStep& step, std::vector<EventFunction>& functions) {
  const bool first = step.h_before == 0;
  if (first) {
    between_states_.at(step.now, step.next, place_inside, between_);
    values_.move_to(between_);
    system_.accelerate({}, between_.a, between_.lambda);
    for (EventFunction& each : functions)
      if (each.by_force()) each.inside = values_.at(each, between_).f;
  }
  for (const EventFunction& function : functions) {
    if (function.at_ends || !function.by_force()) continue;
    const double begin = function.now.f, end = function.next.f, found = first ? *function.inside : end;
    const double straight =
        first ? begin + place_inside * (end - begin) : begin + (begin - function.before) * (step.h / step.h_before);
    const double off = std::abs(found - straight);
    if (off > off_tangent * std::max({std::abs(begin), std::abs(end), function.bound}) &&
        off > resolution_of_force(function))
      return true;
  }
  return false;
}

// [N], or [m/s^2] of a departure: a difference up to this is round-off, as all forces are of bodies that fall together
// and touch.
double StepResolution::resolution_of_force(const EventFunction& function) {
  const double little = (function.is_shared_force() ? jumps_of_shares : 1) * function.little;
  if (function.kind != Kind::press && function.kind != Kind::hold) return little;
  std::vector<model::ContactDirection> along;
  for (int row = 0; row <= system_.tangents(function.contact); ++row) along.push_back({function.contact, row});
  return std::max(little, force_noise(system_, scale_, along));
}

double StepResolution::longest_step(const std::vector<EventFunction>& functions, double h_before, double swings) const {
  constexpr double any = std::numeric_limits<double>::infinity();
  const bool matter = h_before == 0 || swings_matter(functions, &EventFunction::now, most_lengthening * h_before);
  const double resolved = matter ? between_states_.longest_resolved() : any;
  double longest = any;
  for (const EventFunction& function : functions) {
    if (function.kind == Kind::hold || function.kind == Kind::unload) return std::min(swings, resolved);
    if (function.kind == Kind::slide) longest = std::min(longest, part_of_slip * function.now.f / function.steepest);
  }
  return std::min(std::max(swings, longest), resolved);
}

}  // namespace trammel::simulate
