#include "testing/kit/integrators/work_precision.hpp"

#include <algorithm>
#include <cmath>

#include "testing/kit/integrators/order.hpp"
#include "testing/kit/integrators/problems.hpp"

namespace trammel::kit {

namespace {

// The run's error at the problem's quarters, and its cost.
class Measurement {
 public:
  explicit Measurement(const Problem& problem)
      : problem_(problem), sound_(problem.system()), counted_(*sound_, Failing::How::singular) {}

  System& system() { return counted_; }
  double evaluations() const { return counted_.evaluations; }
  void compare(const State& s) {
    Vec off;
    const State exact = problem_.solution(s.t);
    sound_->difference(s.q, exact.q, off);
    square_ += off.squaredNorm() + (s.v - exact.v).squaredNorm();
    ++count_;
  }
  double error() const { return std::sqrt(square_ / std::max(count_, 1)); }

 private:
  const Problem& problem_;
  std::unique_ptr<System> sound_;
  Failing counted_;
  double square_ = 0;
  int count_ = 0;
};

Work fixed(const Maker& make, const Problem& problem, int n) {
  Measurement m(problem);
  Work work{.setting = problem.until / n};
  try {
    const auto method = make();
    int step = 0;
    integrate(*method, m.system(), problem.solution(0), problem.until, n, [&](const State& s) {
      if (++step % (n / 4) == 0) m.compare(s);
    });
    work.error = m.error();
  } catch (const std::exception& e) {
    work.error = std::nan(""), work.failure = e.what();
  }
  work.evaluations = m.evaluations();
  return work;
}

constexpr int most_trials = 20000;

// The standard controller: h' = 0.9 h e^(-1/p), at most 5 times as long or short. Hairer, Norsett, Wanner I, II.4.
Work controlled(const Maker& make, const Problem& problem, double tolerance) {
  Measurement m(problem);
  Work work{.setting = tolerance};
  const auto method = make();
  auto& estimate = dynamic_cast<ErrorEstimate&>(*method);
  const Tolerance asked{tolerance, tolerance};
  State now = problem.solution(0), next;
  double h = 1e-3, quarter = problem.until / 4;
  int trials = 0;
  try {
    method->restart(m.system(), now);
    while (now.t < problem.until * (1 - 1e-12)) {
      if (++trials > most_trials) throw std::runtime_error("more than 20000 steps");
      const double left = quarter - now.t;
      const double taken = h >= left * (1 - 1e-9) ? left : h;
      const bool stepped = bool(method->step(m.system(), now, taken, next));
      const double e = stepped ? estimate.error(m.system(), now, next, asked) : 100;
      const double factor = std::clamp(0.9 * std::pow(std::max(e, 1e-10), -1.0 / estimate.error_order()), 0.2, 5.0);
      // A step that was cut to meet a quarter says nothing of longer ones.
      if (taken == h || factor < 1) h = taken * factor;
      if (!(e <= 1)) continue;
      method->accept(m.system(), now, next);
      std::swap(now, next);
      if (taken == left) m.compare(now), quarter += problem.until / 4;
    }
    work.error = m.error();
  } catch (const std::exception& e) {
    work.error = std::nan(""), work.failure = e.what();
  }
  work.evaluations = m.evaluations();
  return work;
}

}  // namespace

std::vector<Work> with_fixed_steps(const Maker& make, const Problem& problem, int most) {
  std::vector<Work> all;
  for (int n = 8; n <= most; n *= 2) {
    all.push_back(fixed(make, problem, n));
    if (all.back().error < 1e-12) break;
  }
  return all;
}

std::vector<Work> with_controlled_steps(const Maker& make, const Problem& problem) {
  std::vector<Work> all;
  if (!dynamic_cast<ErrorEstimate*>(make().get())) return all;
  for (int e = 3; e <= 9; ++e) all.push_back(controlled(make, problem, std::pow(10, -e)));
  return all;
}

Honesty honesty(const std::vector<Work>& runs) {
  Honesty h;
  double log_sum = 0;
  for (const Work& run : runs) {
    if (!std::isfinite(run.error)) continue;
    const double ratio = std::max(run.error, 1e-16) / run.setting;
    ++h.runs;
    h.deceived += ratio > 10;
    log_sum += std::log(ratio);
    h.largest_ratio = std::max(h.largest_ratio, ratio);
  }
  if (h.runs) h.mean_ratio = std::exp(log_sum / h.runs);
  return h;
}

}  // namespace trammel::kit
