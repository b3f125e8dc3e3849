#include "testing/kit/integrators/order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "testing/flow.hpp"

namespace trammel::kit {

namespace {

// Errors of some thousand steps of numbers about 1 carry round-off of 1e-13; a fit needs ten times more.
constexpr double round_off = 1e-12;
constexpr std::size_t fitted = 4, fewest = 3;

double slope(const std::vector<Convergence::Run>& runs, std::size_t first, std::size_t last) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = double(last - first);
  for (std::size_t i = first; i < last; ++i) {
    const double x = -std::log(runs[i].steps), y = std::log(runs[i].error);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void fit(Convergence& c) {
  const auto useful = [](const Convergence::Run& r) { return std::isfinite(r.error) && r.error > round_off; };
  c.last = c.runs.size();
  while (c.last > 0 && !useful(c.runs[c.last - 1])) --c.last;
  c.first = c.last;
  while (c.first > 0 && useful(c.runs[c.first - 1]) && c.last - c.first < fitted) --c.first;
  c.exact = std::all_of(c.runs.begin(), c.runs.end(), [](const auto& r) { return r.error <= 1e-10; }) &&
            c.last - c.first < fewest;
  if (c.last - c.first < fewest) {
    c.order = std::nan("");
    return;
  }
  c.order = slope(c.runs, c.first, c.last);
  c.uncertainty = std::abs(slope(c.runs, c.last - 2, c.last) - slope(c.runs, c.last - 3, c.last - 1)) / 2;
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
  return text + fmt::format("order {:.3f} +- {:.3f}\n", order, uncertainty);
}

Convergence converge(const std::string& problem, double until, int n_0, int most,
                     const std::function<double(int n)>& error) {
  Convergence c{problem, until};
  int below = 0;
  for (int n = n_0; n <= most && below < 2; n *= 2) {
    double e = std::nan("");
    try {
      e = error(n);
    } catch (const std::runtime_error&) {  // a step was rejected
    }
    c.runs.push_back({n, e});
    below += e <= round_off;
  }
  fit(c);
  return c;
}

Convergence converge(const Maker& make, const Problem& problem, int most) {
  const std::vector<State> exact = solution_at_quarters(problem);
  const State start = problem.solution(0);
  const auto system = problem.system();
  Vec off;
  return converge(problem.name, problem.until, quarters, most, [&](int n) {
    const auto method = make();
    double square = 0;
    int step = 0;
    integrate(*method, *system, start, problem.until, n, [&](const State& s) {
      if (++step % (n / quarters) != 0) return;
      const State& at = exact[std::size_t(step / (n / quarters)) - 1];
      system->difference(s.q, at.q, off);
      square += off.squaredNorm() + (s.v - at.v).squaredNorm();
    });
    return std::sqrt(square / quarters);
  });
}

Report has_order(const Convergence& c, double order) {
  Report report;
  if (c.exact) {
    report.claim(fmt::format("of order {} on {}", order, c.problem), true, "exact to round-off at every step size");
    return report;
  }
  const double allowed = std::min(0.45, 0.2 + c.uncertainty);
  report.claim(fmt::format("of order {} within {:.2f} on {}", order, allowed, c.problem),
               std::abs(c.order - order) <= allowed, fmt::format("found {:.3f}\n{}", c.order, c.table()));
  return report;
}

}  // namespace trammel::kit
