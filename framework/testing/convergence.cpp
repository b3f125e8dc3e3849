// Orders: the slope of log(error) over log(h) by least squares, from halvings of h. The error is the root mean square
// over all steps of a run: at one time alone its leading term may happen to vanish.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <trammel/testing/measurements.hpp>

namespace trammel {
namespace {

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = double(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

Order fit_order(int n, int runs, const std::function<double(int n)>& error) {
  Order order;
  std::vector<double> x, y;
  for (int i = 0; i < runs; ++i, n *= 2) {
    const double e = error(n);
    x.push_back(-std::log(n)), y.push_back(std::log(e));
    order.table += fmt::format("{:8} steps: error {:.4e}\n", n, e);
  }
  order.value = slope(x, y);
  order.table += fmt::format("order {:.4f}\n", order.value);
  return order;
}

Fit measure_order(const Maker& make, const Problem& problem, int n, int runs) {
  if (!problem.closed_form) throw std::invalid_argument(problem.name + " has no closed form to compare with");
  const State start = problem.solution(0);
  Fit fit;
  fit.table = fmt::format("{}\n{:>8} {:>12} {:>12} {:>12}\n", problem.name, "steps", "q", "v", "lambda");
  std::vector<double> x, q, v, lambda;
  for (int i = 0; i < runs; ++i, n *= 2) {
    const auto method = make();
    const auto system = problem.system();
    double eq = 0, ev = 0, el = 0;
    integrate(*method, *system, start, problem.until, n, [&](const State& s) {
      const State exact = problem.solution(s.t);
      eq += (s.q - exact.q).squaredNorm(), ev += (s.v - exact.v).squaredNorm();
      el = (s.lambda - exact.lambda).norm();  // of the last step: the first few may be of lower order
    });
    eq = std::sqrt(eq / n), ev = std::sqrt(ev / n);
    x.push_back(-std::log(n)), q.push_back(std::log(eq)), v.push_back(std::log(ev)), lambda.push_back(std::log(el));
    fit.table += fmt::format("{:8} {:12.4e} {:12.4e} {:12.4e}\n", n, eq, ev, el);
  }
  fit.order_q = slope(x, q), fit.order_v = slope(x, v);
  fit.order_lambda = start.lambda.size() ? slope(x, lambda) : std::nan("");
  fit.table += fmt::format("{:>8} {:12.4f} {:12.4f} {:12.4f}\n", "order", fit.order_q, fit.order_v, fit.order_lambda);
  return fit;
}

namespace {

// Of a method with steps of its own (Traits::order = 0): the errors at all steps agree.
Report check_no_order(const Maker& make, const Problem& problem, int n) {
  constexpr double alike = 2;  // they are sampled at other times
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const Order errors = fit_order(n, 4, [&](int steps) {
    const auto method = make();
    const auto system = problem.system();
    double sum = 0;
    integrate(*method, *system, problem.solution(0), problem.until, steps, [&](const State& s) {
      const State exact = problem.solution(s.t);
      sum += (s.q - exact.q).squaredNorm() + (s.v - exact.v).squaredNorm();
    });
    const double error = std::sqrt(sum / steps);
    least = std::min(least, error), most = std::max(most, error);
    return error;
  });
  Report report;
  report.claim(fmt::format("the error on {} does not depend on the step", problem.name), most <= alike * least,
               errors.table);
  return report;
}

}  // namespace

Report check_order(const Maker& make, const Problem& problem, double order, int n, double tolerance) {
  if (make()->traits().order == 0) return check_no_order(make, problem, n);
  const Fit fit = measure_order(make, problem, n);
  Report report;
  report.claim(fmt::format("q and v are of order {} on {}", order, problem.name),
               std::abs(fit.order_q - order) <= tolerance && std::abs(fit.order_v - order) <= tolerance, fit.table);
  return report;
}

}  // namespace trammel
