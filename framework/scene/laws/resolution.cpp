#include "scene/laws/resolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/laws/law_code.hpp"

namespace trammel::scene {
namespace {

constexpr double well_shown = 0.05;    // of what f varies by in the step: a departure of the cubic up to this
constexpr double no_variation = 1e-8;  // of the largest |f| seen: less than this is no event of a force, nor of a place
constexpr std::array c = {0.0, 3.0 / 4, 1.0 / 16, 1.0 / 96, 1.0 / 384};
constexpr int slopes = 1, bounds = 4;  // derivatives of f that are used at the ends of the step, and within it
constexpr int most_derivatives = 2;    // of a law in the equations of motion

// f is the d-th derivative of a law whose series at the ends of the step and within it are given.
bool shows(const Series& begin, const Series& within, const Series& end, int d, double h, double largest_seen) {
  const double f0 = begin.derivative(d).lower(), f1 = end.derivative(d).lower();
  const double bend = begin.derivative(d + 1).lower() - end.derivative(d + 1).lower();
  const double middle = (f0 + f1) / 2 + h / 8 * bend;
  if (!std::isfinite(f0) || !std::isfinite(f1)) return false;
  const double variation = std::max({f0, f1, middle}) - std::min({f0, f1, middle});
  const double allowed = std::max(well_shown * variation, no_variation * largest_seen);
  double power = 1;
  for (int m = 1; m <= bounds && d + m <= within.smooth; ++m) {
    power *= h;
    const Range fm = within.derivative(d + m);
    if (c[std::size_t(m)] * power * (m < bounds ? half_width(fm) : largest(fm)) <= allowed) return true;
  }
  return false;
}

using View = Series (*)(const Series&);  // of the law: itself, its sine or cosine

// The largest |f^(d)| at the times looked at: t, and t +- h for each h tried. A short pulse is of the size that it has
// within this distance, so its tails need no short steps.
struct LargestSeen {
  std::array<double, most_derivatives + 1> of{};
  void add(const Series& at, int derivatives) {
    for (int d = 0; d <= derivatives; ++d)
      if (const double size = largest(at.derivative(d)); std::isfinite(size)) of[d] = std::max(of[d], size);
  }
};

double step_that_shows(const LawOfTime& law, View view, double t, double h, double least) {
  const auto series = [&](const Range& time, int more) {
    return view(law.law.code()->enclose(time, law.derivatives + more));
  };
  const Series begin = series(t, slopes);
  LargestSeen seen;
  seen.add(begin, law.derivatives);
  for (; h >= 2 * least; h /= 2) {
    const Series end = series(t + h, slopes), within = series({t, t + h}, bounds);
    seen.add(end, law.derivatives);
    seen.add(series(t - h, 0), law.derivatives);
    bool shown = true;
    for (int d = 0; d <= law.derivatives; ++d) shown = shown && shows(begin, within, end, d, h, seen.of[d]);
    if (shown) break;
  }
  return h;
}

}  // namespace

double step_that_shows(const LawOfTime& law, double t, double h, double least) {
  h = step_that_shows(
      law, [](const Series& u) { return u; }, t, h, least);
  if (!law.is_angle) return h;
  h = step_that_shows(
      law, [](const Series& u) { return sin(u); }, t, h, least);
  return step_that_shows(
      law, [](const Series& u) { return cos(u); }, t, h, least);
}

}  // namespace trammel::scene
