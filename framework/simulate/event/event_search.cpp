// What happened within a step, from the functions' values and slopes at its ends.
#include <algorithm>
#include <cmath>

#include "simulate/contact/force_noise.hpp"
#include "simulate/event/event_location.hpp"

namespace trammel::simulate {
namespace {

// The places in a step where `hides` looks: irrational parts, of the golden section, resonate with no period of a law.
constexpr double inside = 0.3819660112501051;
constexpr double places[] = {inside, 0.7639320225002103, 0.1458980337503154};
constexpr double off_ends = 1e-3;         // of an interval: a minimum is sought no nearer to its ends
constexpr double part_for_slopes = 1e-3;  // of the step: the difference in time that gives a force's slope
constexpr double hides_nothing = 1e-6;    // of the longest step so far: shorter ones come from the location of events
constexpr double jumps_of_shares = 10;    // of vanished_force: shares follow the motion in small jumps
constexpr double new_spare_load = 1e-3;   // of the largest load: less may be left of the spare load that was just lost
constexpr int most_probes = 6;
constexpr double far_gap = 20;         // of the change of a gap in a step at its rate: a larger gap cannot close
constexpr double as_steep = 4;         // of the steepest slip so far: a steeper one is new
constexpr double off_cubic = 0.05;     // of a gap or slip: a larger departure from the cubic is more than its error
constexpr double could_cross = 4;      // of such a departure: values up to this may have been 0 in the step
constexpr double off_tangent = 0.5;    // of a force: a larger departure from its tangent
constexpr double near_zero = 0.25;     // of the values at the ends: a minimum below this may be a zero
constexpr double after_return = 1.25;  // of the time 2 u/|A| after which a gap closes again: it has closed by then

// In space a slip is followed to its end by steps that leave at least `left_of_slip` of it. Near its zero the stiffness
// mu N/|s| across it is more than an explicit method can bear; round-off there would become a turn. Slips up to
// `nearly_least` times `least` may end within a step.
constexpr double left_of_slip = 0.2, nearly_least = 10;
bool overshoots(double begin, double end, double least) {
  return begin > nearly_least * least && end < left_of_slip * begin;
}

}  // namespace

// The cubic with values F and slopes S at both ends of [low, high] (Hermite).
struct EventLocation::Cubic {
  double low, high, F_low, F_high, S_low, S_high;
  double at = 0, minimum = 0;  // filled by `dips`

  // True if it has a minimum inside, which it finds.
  bool dips() {
    const double h = high - low, d = (F_high - F_low) / h;
    const double a = 3 * (S_low + S_high - 2 * d), b = 2 * (3 * d - 2 * S_low - S_high),
                 c = S_low;  // slope: a x^2 + b x + c
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return false;
    const double root = std::sqrt(discriminant);
    double x = b >= 0 ? -2 * c / (b + root) : (root - b) / (2 * a);  // where the slope rises
    if (S_low < 0 && S_high > 0) x = std::clamp(x, off_ends, 1 - off_ends);
    if (!(x >= off_ends && x <= 1 - off_ends)) return false;
    at = low + h * x;
    minimum = value(x);
    return true;
  }
  // The distance of bodies that pass each other is convex, and so is the load of a joint's bearings, a sum of lengths.
  // Such a function is at least as large as its tangents at the ends, which meet where it may have a kink that the
  // cubic rounds off. True if they meet below 0.
  bool tangents_cross() {
    if (!(S_low < 0 && S_high > 0)) return false;
    const double x = (F_low - F_high + S_high * (high - low)) / (S_high - S_low);
    if (!(x > 0 && x < high - low && F_low + S_low * x < 0)) return false;
    at = low + x;
    return true;
  }
  double value(double x) const {
    const double h = high - low, d = (F_high - F_low) / h;
    return F_low + h * x * (S_low + x * (3 * d - 2 * S_low - S_high + x * (S_low + S_high - 2 * d)));
  }
};

// True if the step is too long to show what the functions did within it.
bool EventLocation::hides(const State& now, double h, const State& next) {
  longest_ = std::max(longest_, h);
  if (h < hides_nothing * longest_) return false;
  bool motions = false, forces = false;
  for (int k = 0; k < int(functions_.size()); ++k) {
    if (functions_[k].kind == Kind::slide && system_.tangents(functions_[k].contact) > 1 &&
        overshoots(now_[k].f, next_[k].f, system_.modes().contacts[functions_[k].contact].least_slip))
      return true;
    // A step longer than swings allow, in which a slip has become steeper than ever before.
    if (functions_[k].kind == Kind::slide && std::abs(next_[k].slope) > as_steep * functions_[k].steepest &&
        std::abs(next_[k].slope) * h > now_[k].f && now_[k].f > functions_[k].noise)
      return true;
    if (functions_[k].at_ends || of_rows(k)) continue;
    (by_force(k) ? forces : motions) = true;
  }
  if (h > between_states_.longest_resolved() && (swings_matter(now_, h) || swings_matter(next_, h))) return true;
  return (motions && hides_motion(now, h, next)) || (forces && hides_force(now, h, next));
}

// After an event that left all contacts closed, sticking and sliding as they were. If others are idle now, or other
// springs press, a force or spare load that was 0 at the event is a new one. A function of a spare load begins at
// `little`.
bool EventLocation::shares_otherwise(int k) const {
  const EventFunction& function = functions_[k];
  if (function.kind == Kind::unload)
    return other_springs_ || now_[k].f > function.little + new_spare_load * function.bound;
  return is_shared_force(function) && now_[k].f > jumps_of_shares * function.little;
}

// True if swings within steps of length h could hide an event: of a force, or of a gap that is small for its rate.
bool EventLocation::swings_matter(const std::vector<Value>& values, double h) const {
  for (int k = 0; k < int(functions_.size()); ++k) {
    if (functions_[k].at_ends || functions_[k].kind == Kind::slide) continue;
    if (by_force(k) || values[k].f < far_gap * h * std::abs(values[k].slope)) return true;
  }
  return false;
}

// Compares gaps and slips within the step with the cubics between its ends. Where a base moves by a law of time they
// may swing within the step although the bodies do not, and the error estimate of the step does not show it.
bool EventLocation::hides_motion(const State& now, double h, const State& next) {
  for (const double place : places) {
    between_states_.at(now, next, place, between_);
    system_.move_to(between_.t, between_.q, between_.v);
    for (int k = 0; k < int(functions_.size()); ++k) {
      if (functions_[k].at_ends || !has_slope(k)) continue;
      const Value &begin = now_[k], &end = next_[k];
      const Cubic cubic{0, h, begin.f, end.f, begin.slope, end.slope};
      const double there = gap_or_slip(k), off = std::abs(there - cubic.value(place));
      const double size = std::max(std::abs(begin.f), std::abs(end.f));
      if (off > off_cubic * size && could_cross * off > std::min({begin.f, end.f, there}) &&
          off > resolution_of_motion(k))
        return true;
    }
  }
  return false;
}

// A difference of gaps [m] or slips [m/s] up to this is round-off.
double EventLocation::resolution_of_motion(int k) const {
  const Scale scale = scale_.of(functions_[k].contact);
  return functions_[k].kind == Kind::slide ? scale.drift() : scale.touching();
}

// Compares the force with its tangent of the step before; in the first step, with the line between its ends.
bool EventLocation::hides_force(const State& now, double h, const State& next) {
  if (h_before_ == 0) {
    between_states_.at(now, next, inside, between_);
    system_.move_to(between_.t, between_.q, between_.v);
    system_.accelerate({}, between_.a, between_.lambda);
    evaluate(between_, probe_);
    probed_ = true;
  }
  for (int k = 0; k < int(functions_.size()); ++k) {
    if (functions_[k].at_ends || !by_force(k)) continue;
    const double size = std::max({std::abs(now_[k].f), std::abs(next_[k].f), functions_[k].bound});
    const double straight = h_before_ == 0 ? now_[k].f + inside * (next_[k].f - now_[k].f)
                                           : now_[k].f + (now_[k].f - functions_[k].force_before) * (h / h_before_);
    const double found = h_before_ == 0 ? probe_[k].f : next_[k].f, off = std::abs(found - straight);
    if (off > off_tangent * size && off > resolution_of_force(k)) return true;
  }
  return false;
}

// [N], or [m/s^2] of a departure: a difference up to this is round-off, as all forces are of bodies that fall together
// and touch.
double EventLocation::resolution_of_force(int k) {
  const EventFunction& function = functions_[k];
  const double little = (is_shared_force(function) ? jumps_of_shares : 1) * function.little;
  if (function.kind != Kind::press && function.kind != Kind::hold) return little;
  std::vector<model::ContactDirection> along;
  for (int row = 0; row <= system_.tangents(function.contact); ++row) along.push_back({function.contact, row});
  return std::max(little, force_noise(system_, scale_, along));
}

// True if the function is negative within the step and not at its ends.
bool EventLocation::dips(const State& now, double h, const State& next, int k, Suspect& suspect) {
  const bool force = by_force(k), may_have_kink = !force || system_.model().contacts[functions_[k].contact].joint;
  Cubic cubic{0, h, now_[k].f, next_[k].f, now_[k].slope, next_[k].slope};
  if (cubic.F_high <= 0) return false;
  // Contacts may hold at the instant of an event, exactly at their bound, and not after it.
  if (force && just_handled(k) && cubic.F_high <= functions_[k].noise) return false;
  // A gap that falls faster than an impact may have left it closes at once, whatever it is at the end.
  const bool falls_at_once =
      functions_[k].kind != Kind::slide && cubic.S_low < -scale_.of(functions_[k].contact).left_by_impacts();
  if (!force && just_handled(k) && cubic.S_low <= 0 && !falls_at_once) return false;
  if (force) {
    if (!worth_slopes(k, h)) return false;
    cubic.S_low = slope_at_end(now, part_for_slopes * h, k, h, begin_slopes_);
    cubic.S_high = slope_at_end(next, -part_for_slopes * h, k, h, end_slopes_);
  }
  for (int probes = 0; probes < most_probes; ++probes) {
    if (!cubic.dips()) return false;
    const bool near = cubic.minimum <= near_zero * std::min(cubic.F_low, cubic.F_high);
    if (!near && !(may_have_kink && cubic.tangents_cross())) return false;
    const double at = cubic.at;
    const Value there = step_to(now, at, k);
    if (there.f < 0 && happened(now, k, there)) {
      suspect.high = at, suspect.at_high = there;
      return true;
    }
    const double slope = force ? force_slope(trial_, part_for_slopes * h, k) : there.slope;
    if (slope < 0)
      cubic.low = at, cubic.F_low = there.f, cubic.S_low = slope;
    else
      cubic.high = at, cubic.F_high = there.f, cubic.S_high = slope;
  }
  return false;
}

// A gap that an event has just left at 0 with rate u and acceleration A < 0 closes again after about -2 u/A.
bool EventLocation::returns(const State& now, double h, int k, Suspect& suspect) {
  if (by_force(k) || functions_[k].kind == Kind::slide || !just_handled(k) || !(now_[k].slope > 0)) return false;
  const double A = gap_acceleration(now, k);
  const double at = -2 * after_return * now_[k].slope / A;
  if (!(A < 0 && at < h)) return false;
  const Value there = step_to(now, at, k);
  if (!happened(now, k, there)) return false;
  suspect.high = at, suspect.at_high = there;
  return true;
}

// Each slope of a force costs a solution of the equations of motion. It is worth it if the force is so small, compared
// with its change and the curvature of its last three values, that it could have crossed 0 and come back.
bool EventLocation::worth_slopes(int k, double h) const {
  const double least = std::min(now_[k].f, next_[k].f), change = next_[k].f - now_[k].f;
  if (h_before_ == 0 && !probed_) return true;
  // The second difference of a parabola through three values; in the first step the third one is inside the step.
  const double bend = h_before_ == 0 ? (probe_[k].f - now_[k].f - inside * change) * 2 / (inside * (1 - inside))
                                     : change - (now_[k].f - functions_[k].force_before) * (h / h_before_);
  return least < 0.5 * (std::abs(change) + std::abs(bend));
}

double EventLocation::force_slope(const State& state, double dt, int k) {
  double slope = 0;
  force_slopes(state, dt,
               [&](double sign, double t, const Vec& lambda) { slope += sign * force(functions_[k], t, lambda) / dt; });
  return slope;
}

// On the first call for this end, computes the slopes of all forces for which they are worth it.
double EventLocation::slope_at_end(const State& state, double dt, int k, double h, std::vector<double>& slopes) {
  if (slopes.empty()) {
    slopes.resize(functions_.size());
    force_slopes(state, dt, [&](double sign, double t, const Vec& lambda) {
      for (int i = k; i < int(functions_.size()); ++i)
        if (by_force(i) && !functions_[i].at_ends && worth_slopes(i, h))
          slopes[i] += sign * force(functions_[i], t, lambda) / dt;
    });
  }
  return slopes[k];
}

// Calls each(-1, t, lambda) at the state, then each(1, t + dt, lambda) at the state extrapolated by its velocity and
// acceleration.
template <class Each>
void EventLocation::force_slopes(const State& state, double dt, Each&& each) {
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  each(-1, state.t, lambda_);
  dq_ = dt * state.v + (0.5 * dt * dt) * state.a;
  system_.retract(state.q, dq_, moved_.q);
  moved_.v = state.v + dt * state.a;
  system_.move_to(state.t + dt, moved_.q, moved_.v);
  system_.accelerate({}, a_, lambda_);
  each(1, state.t + dt, lambda_);
}

}  // namespace trammel::simulate
