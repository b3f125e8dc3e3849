#include "testing/kit/integrators/order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "testing/flow.hpp"

namespace trammel::kit {

namespace {

// The references carry some 1e-13, and so do errors of some thousand steps of numbers about 1; this may change slopes
// by a few hundredths only.
constexpr double round_off = 1e-11;

double slope(const std::vector<Convergence::Run>& runs, std::size_t first, std::size_t last) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = double(last - first);
  for (std::size_t i = first; i < last; ++i) {
    const double x = -std::log(runs[i].steps), y = std::log(runs[i].error);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double slope_between(const Convergence::Run& coarse, const Convergence::Run& fine) {
  return std::log(coarse.error / fine.error) / std::log(double(fine.steps) / coarse.steps);
}

// s = p + c h through the slopes of the last two halvings, each at the middle of its steps.
void extrapolate(Convergence& c) {
  const auto &last = c.runs[c.last - 1], &before = c.runs[c.last - 1 - c.halving],
             &first = c.runs[c.last - 1 - 2 * c.halving];
  const double h_1 = 1 / std::sqrt(double(first.steps) * before.steps),
               h_2 = 1 / std::sqrt(double(before.steps) * last.steps);
  c.slope = slope_between(before, last);
  c.limit = (c.slope * h_1 - slope_between(first, before) * h_2) / (h_1 - h_2);
}

void fit(Convergence& c) {
  const auto useful = [](const Convergence::Run& r) { return std::isfinite(r.error) && r.error > round_off; };
  c.last = c.runs.size();
  while (c.last > 0 && !useful(c.runs[c.last - 1])) --c.last;
  if (c.last > 1 && 2 * c.runs[c.last - 2].steps > c.runs[c.last - 1].steps) c.halving = 2;
  c.first = c.last;
  while (c.first > 0 && useful(c.runs[c.first - 1]) && c.last - c.first <= 4 * c.halving) --c.first;
  c.order = c.slope = c.limit = std::nan("");
  if (!c.measured()) return;
  c.order = slope(c.runs, c.first, c.last);
  extrapolate(c);
}

// Every run that was not rejected is near round-off.
bool reaches_round_off(const Convergence& c) {
  return !c.runs.empty() && c.runs.back().error <= 1e-9;
}

constexpr int quarters = 4;

std::vector<State> solution_at_quarters(const Problem& problem) {
  std::vector<State> at;
  const auto system = problem.system();
  State now = problem.solution(0);
  constexpr int parts = 40;  // to round-off while a part is short beside the fastest motion
  const double h = problem.until / (quarters * parts);
  for (int k = 1; k <= quarters; ++k) {
    const double t = problem.until * k / quarters;
    if (problem.closed_form) {
      now = problem.solution(t);
    } else {
      for (int i = 0; i < parts; ++i) now = exact_flow(*system, now, h);
    }
    at.push_back(now);
  }
  return at;
}

}  // namespace

std::string Convergence::table() const {
  std::string text = fmt::format("{}\n{:>12} {:>12}\n", problem, "h [s]", "error");
  for (std::size_t i = 0; i < runs.size(); ++i)
    text += std::isfinite(runs[i].error) ? fmt::format("{:12.4e} {:12.4e}{}\n", until / runs[i].steps, runs[i].error,
                                                       first <= i && i < last ? "  fitted" : "")
                                         : fmt::format("{:12.4e} {:>12}\n", until / runs[i].steps, "rejected");
  return text + fmt::format("order {:.3f}; slope of the last halving {:.3f}, extrapolated to h = 0 {:.3f}\n", order,
                            slope, limit);
}

std::vector<int> step_numbers(int n_0, int most, int order) {
  std::vector<int> all;
  for (int n = n_0; n <= most; n *= 2) {
    all.push_back(n);
    if (order > 4 && n > n_0 && 3 * n / 2 <= most) all.push_back(3 * n / 2);
  }
  return all;
}

Convergence converge(const std::string& problem, double until, const std::vector<int>& steps,
                     const std::function<double(int n)>& error) {
  Convergence c{problem, until};
  int below = 0;
  for (const int n : steps) {
    double e = std::nan("");
    try {
      e = error(n);
    } catch (const std::runtime_error&) {  // a step was rejected
    }
    c.runs.push_back({n, e});
    below += e <= round_off;
    if (below == 2) break;
  }
  fit(c);
  return c;
}

Convergence converge(const Maker& make, const Problem& problem, int most) {
  const std::vector<State> exact = solution_at_quarters(problem);
  const State start = problem.solution(0);
  const auto system = problem.system();
  const double size_v = std::max(1.0, start.v.norm());
  Vec off;
  const int order = make()->traits().order;
  return converge(problem.name, problem.until, step_numbers(quarters, most, order), [&](int n) {
    const auto method = make();
    double square = 0;
    int step = 0;
    integrate(*method, *system, start, problem.until, n, [&](const State& s) {
      if (++step % (n / quarters) != 0) return;
      const State& at = exact[std::size_t(step / (n / quarters)) - 1];
      system->difference(s.q, at.q, off);
      square += off.squaredNorm() + ((s.v - at.v) / size_v).squaredNorm();
    });
    return std::sqrt(square / quarters);
  });
}

Report has_order(const Convergence& c, int order) {
  Report report;
  if (!c.measured()) {
    report.claim(fmt::format("of order {} on {}", order, c.problem), order >= 5 && reaches_round_off(c),
                 fmt::format("too few runs between the first step that is accepted and round-off\n{}", c.table()));
    return report;
  }
  const bool from_below = order > 6;
  const double tolerance = from_below ? 0.4 : 0.2;
  const double low = std::min(c.slope, c.limit) - tolerance, high = std::max(c.slope, c.limit) + tolerance;
  // One of them rounds to the claimed order, so that neither neighbour passes however much slopes still change.
  const bool rounds_to_it = std::min(std::abs(c.slope - order), std::abs(c.limit - order)) < 0.5;
  const bool from_both_sides = rounds_to_it && low <= order && order <= high;
  const bool holds = from_below ? std::max(c.slope, c.order) >= order - tolerance : from_both_sides;
  report.claim(fmt::format("of order {} within {} on {}", order, tolerance, c.problem), holds,
               fmt::format("found {:.2f}, and {:.2f} extrapolated to h = 0\n{}", c.slope, c.limit, c.table()));
  return report;
}

void claim_shrinks(Report& report, const Convergence& c, int order) {
  const bool round_off_at_once = !c.measured() && reaches_round_off(c);
  const double slope = std::max(c.slope, std::max(c.limit, c.order));
  report.claim(fmt::format("{} shrinks with order {} or higher", c.problem, order),
               round_off_at_once || slope >= order - 0.3, fmt::format("found {:.2f}\n{}", slope, c.table()));
}

}  // namespace trammel::kit
