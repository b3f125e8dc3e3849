// Checks the error estimate of a method against the true local error, over runs with steps h, h/2, h/4.
//
//     ratio = rms over the steps of the estimate / rms of the error      p: order of the method, p_e = error_order()
//
// p_e > p: the estimate is the leading term of the error, so the ratio tends to 1 with a deviation of O(omega h).
// p_e <= p: it is the error of an embedded method of lower order, so the ratio grows by 1/(omega h)^(p + 1 - p_e) and
// is at least 1. With rows, the part of the error across them is estimated, and then removed by methods that satisfy
// rows: there the ratio may be larger, not smaller.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include <trammel/testing/measurements.hpp>

#include "testing/flow.hpp"

namespace trammel {
namespace {

// After these steps the method's accelerations have forgotten their start, and a history is filled.
constexpr int steps_before = 40, steps_counted = 40;

double mean_square(const Vec& e) {
  return e.squaredNorm() /
         double(2 * e.size());  // of the q and v of as many coordinates, as error_norm.hpp counts them
}

// Rows satisfied by positions only: the velocities oscillate across the rows and are not estimated.
bool positions_alone(const Traits& traits) {
  return traits.holds_position && !traits.holds_velocity;
}

// A flow that starts with this oscillation leaves the rows: it is compared with the flow along them.
State without_ripple(System& s, State now) {
  s.move_to(now.t, now.q, now.v);
  if (now.lambda.size() == 0) return now;
  const Vec no_force = Vec::Zero(now.lambda.size()), zero = Vec::Zero(now.v.size()), off = s.g_dot();
  Vec change, impulse;
  s.factorise({1, 0, 0}, zero, no_force, Factors::projection);
  if (s.correct(zero, off, change, impulse, Factors::projection)) now.v += change;
  return now;
}

struct Squares {
  double estimated = 0, true_ = 0;
};

// Over n * steps_counted steps of h / n, from the same time for each n.
Squares add_up(Integrator& method, ErrorEstimate& estimate, const Problem& problem, double h, int n) {
  h /= n;
  const auto system = problem.system(), flow = problem.system();
  const bool of_positions = positions_alone(method.traits());
  State now = problem.solution(0), next;
  method.restart(*system, now);
  Squares sum;
  Vec off;
  for (int i = 0; i < n * (steps_before + steps_counted); ++i) {
    if (const Outcome outcome = method.step(*system, now, h, next); !outcome)
      throw std::runtime_error(fmt::format("step {} at t = {:.6g} s was rejected: {}", i + 1, now.t, outcome.reason()));
    if (i >= n * steps_before) {
      const State exact = exact_flow(*flow, of_positions ? without_ripple(*flow, now) : now, h);
      flow->difference(next.q, exact.q, off);
      sum.true_ += mean_square(off) + (of_positions ? 0 : mean_square(next.v - exact.v));
      sum.estimated += std::pow(estimate.error(*system, now, next, {.relative = 0, .absolute = 1}), 2);
    }
    method.accept(*system, now, next);
    std::swap(now, next);
  }
  return sum;
}

}  // namespace

EstimateFit measure_estimate(const Maker& make, const Problem& problem, double h, int runs) {
  EstimateFit fit;
  fit.table = fmt::format("{}\n{:>10} {:>12} {:>12} {:>10}\n", problem.name, "h", "estimate", "error", "ratio");
  const Order order = fit_order(1, runs, [&](int n) {
    const auto method = make();
    auto* estimate = dynamic_cast<ErrorEstimate*>(method.get());
    if (!estimate) throw std::invalid_argument("the method offers no error estimate");
    const Squares sum = add_up(*method, *estimate, problem, h, n);
    fit.claimed_order = estimate->error_order();
    const double count = n * steps_counted, estimated = std::sqrt(sum.estimated / count);
    fit.runs.push_back({h / n, estimated, std::sqrt(sum.true_ / count)});
    const EstimateFit::Run& run = fit.runs.back();
    fit.table += fmt::format("{:10.3e} {:12.4e} {:12.4e} {:10.4f}\n", run.h, run.estimate, run.error, run.ratio());
    return estimated;
  });
  fit.order = order.value;
  fit.table += fmt::format("order of the estimate {:.4f}, claimed {}\n", fit.order, fit.claimed_order);
  return fit;
}

Report check_estimate(const Maker& make, const Problem& problem, double omega, double h) {
  Report report;
  if (!dynamic_cast<ErrorEstimate*>(make().get())) {
    report.claim("offers no error estimate: not asked", true);
    return report;
  }
  const EstimateFit fit = measure_estimate(make, problem, h);
  // The next term is of relative size omega h, which is small enough for the method's own order to be measured.
  report.claim(fmt::format("the estimate is of order {} on {}", fit.claimed_order, problem.name),
               std::abs(fit.order - fit.claimed_order) <= 0.35, fit.table);
  const bool rows = problem.solution(0).lambda.size() > 0;
  const int lower = make()->traits().order + 1 - fit.claimed_order;
  if (lower <= 0) {
    // The part across rows is as large as that along them, or a few times larger where the motion turns.
    const double least = 0.9, most = rows ? 4 : 1.1, ratio = fit.runs.back().ratio();
    report.claim(fmt::format("the estimate is {} to {} times the error", least, most), least <= ratio && ratio <= most,
                 fmt::format("found {:.4f}", ratio));
    return report;
  }
  // Leading coefficients of methods one order apart differ by a factor of up to 1/100.
  const EstimateFit::Run& coarse = fit.runs.front();
  const double most = 100 / std::pow(omega * coarse.h, lower);
  constexpr double round_off = 1e-13;  // of some hundred operations on numbers about 1
  report.claim(fmt::format("the estimate is 1 to {:.3g} times the error", most),
               coarse.error < round_off || (1 <= coarse.ratio() && coarse.ratio() <= most),
               fmt::format("found {:.4g}", coarse.ratio()));
  return report;
}

}  // namespace trammel
