#include "simulate/event/first_event.hpp"

#include <algorithm>
#include <cmath>

#include "linear/dense/eps.hpp"
#include "simulate/event/root_bracket.hpp"

namespace trammel::simulate {
namespace {

constexpr double part_of_scale = 1e-3;  // of what counts as touching or at rest: a function located so near is at 0
constexpr double units_in_t = 4;        // units in the last place of t: the shortest step

// By the values and slopes at the ends.
double predicted(const Suspect& suspect) {
  const ValueAndSlope& begin = suspect.function->now;
  if (!(begin.f > 0 && suspect.at_high.f < 0)) return suspect.high;
  if (!suspect.function->has_slope()) return suspect.high * begin.f / (begin.f - suspect.at_high.f);
  return numerics::Cubic{0, suspect.high, begin, suspect.at_high}.crossing();
}

// After the first is located, most others need only one step, which shows that they come later.
void sort_by_prediction(std::vector<Suspect>& suspects) {
  for (Suspect& s : suspects) s.about = predicted(s);
  std::stable_sort(suspects.begin(), suspects.end(), [](const auto& a, const auto& b) { return a.about < b.about; });
}

// Of an event that was just handled: looks for a time at which the function is positive again, from which it falls to
// its event. False: there is none before `bracket.high`.
bool find_apart(EventFunction& function, numerics::Cubic& bracket, double resolution, StepsFromNow& steps) {
  double apart = bracket.high;
  while (apart > resolution) {
    apart /= 2;
    const ValueAndSlope there = steps.at(function, apart);
    if (there.f > 0) {
      bracket.low = apart, bracket.at_low = there;
      return true;
    }
    // So near that nothing shows yet: a step to there would find no event, without end.
    if (!steps.happened(function, there)) return false;
    bracket.high = apart, bracket.at_high = there;
  }
  return false;
}

double locate(const Suspect& suspect, double t, StepsFromNow& steps) {
  EventFunction& function = *suspect.function;
  const double resolution = 2 * eps * std::max(std::abs(t), std::abs(t + suspect.high));
  numerics::Cubic bracket{0, suspect.high, function.now, suspect.at_high};
  if (function.just_handled() && !find_apart(function, bracket, resolution, steps)) return bracket.high;
  if (!function.has_slope()) {
    const auto f = [&](double h) { return steps.at(function, h).f; };
    return numerics::narrow(f, {bracket.low, bracket.high, bracket.at_low.f, bracket.at_high.f}, resolution).high;
  }
  const Scale scale = steps.scale(function);
  const double round_off =
      part_of_scale * (function.kind == EventFunction::Kind::slide ? scale.rest_speed() : scale.touching());
  return numerics::crossing([&](double h) { return steps.at(function, h); }, bracket, resolution, round_off);
}

}  // namespace

double shortest_step(double t) {
  return units_in_t * eps * std::abs(t);
}

Located locate_first(std::vector<Suspect> suspects, double t, double h, StepsFromNow& steps) {
  sort_by_prediction(suspects);
  Located first{nullptr, h};
  for (Suspect& suspect : suspects) {
    if (suspect.high > first.h) {
      const ValueAndSlope there = steps.at(*suspect.function, first.h);
      if (!steps.happened(*suspect.function, there)) continue;
      suspect.high = first.h, suspect.at_high = there;
    }
    const double located = locate(suspect, t, steps);
    if (!first.function || located < first.h) first.function = suspect.function;
    first.h = std::min(first.h, located);
  }
  const double shortest = shortest_step(std::max(std::abs(t), std::abs(t + h)));
  first.h = std::min(h, std::max(first.h, shortest));
  return first;
}

}  // namespace trammel::simulate
