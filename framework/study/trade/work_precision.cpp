#include "study/trade/work_precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/page.hpp"

namespace trammel::study {
namespace {

constexpr int most_runs = 6;            // of one method
constexpr double too_expensive = 3;     // times the cheapest so far
constexpr int most_levels = 19;         // of any method
constexpr double left_for_rest = 0.35;  // of the budget: for the model and for verifying the choice
constexpr double least_limit = 0.02;    // [s] of CPU time of a run, beside what the cheapest takes
constexpr int repetitions = 5;
constexpr double part_of_repetitions = 0.1;  // of the budget
constexpr int first_fixed_level = 2;         // 4 h 2^-2 = h: the scene's own step
constexpr int jump = 3;                      // levels from a failed run, whose error is unknown, to the next one

// Expected change of log10 of the error per level: a tolerance falls by 10^0.5, and so does an error that is
// proportional to it; a step is halved.
double expected_slope(const Method& method) {
  return method.varied == Method::Varied::tolerance ? -0.5 : -method.order * std::log10(2.0);
}
// Change of log10 of the cost per level: the number of steps of a method of order p is proportional to the tolerance
// to the power -1/(p + 1).
double cost_slope(const Method& method) {
  return method.varied == Method::Varied::tolerance ? 0.5 / (method.order + 1) : std::log10(2.0);
}

double logarithm(double error) {
  return std::log10(std::max(error, report::least_drawn));
}

// The loosest level that is expected to meet the target before any run. Local errors add up, so a tolerance is one
// level tighter than the target.
int first_level(const Method& method, double target) {
  if (method.varied == Method::Varied::step) return first_fixed_level;
  return std::clamp(int(std::ceil(2 * (-std::log10(target) - 2))) + 1, 0, method.levels() - 1);
}

// Levels up to `fails` do not meet the target, `meets` does; -1 and levels() if there is no such run.
struct Bracket {
  int fails, meets;
};
Bracket bracket_of(const Course& course, double target) {
  Bracket b{-1, course.method.levels()};
  for (const auto& [level, s] : course.samples)
    if (s.done() && s.error.max <= target) b.meets = std::min(b.meets, level);
  for (const auto& [level, s] : course.samples)
    if (level < b.meets) b.fails = std::max(b.fails, level);
  return b;
}

// The level at which the error is expected to equal the target: on a line through the errors at both ends of the
// bracket, or through one of them with the slope of the method's order.
double level_of(double target, const Course& course, const Bracket& bracket) {
  const auto known = [&](int level) -> const Sample* {
    const auto found = course.samples.find(level);
    return found != course.samples.end() && found->second.done() ? &found->second : nullptr;
  };
  const Sample *a = known(bracket.fails), *b = known(bracket.meets);
  double slope = expected_slope(course.method);
  if (a && b && logarithm(b->error.max) < logarithm(a->error.max))
    slope = (logarithm(b->error.max) - logarithm(a->error.max)) / (bracket.meets - bracket.fails);
  const Sample* from = b ? b : a;
  if (!from) return bracket.fails + jump;
  return (b ? bracket.meets : bracket.fails) + (std::log10(target) - logarithm(from->error.max)) / slope;
}

}  // namespace

int Course::deceived() const {
  return int(std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.second.deceived; }));
}

WorkPrecision::WorkPrecision(const Methods& methods, const TradeReference& reference, const Measure& measure,
                             Runner& run)
    : reference_(reference), measure_(measure), run_(run) {
  for (const Method& method : methods.capable) courses_.push_back({method, {}, ""});
}

int WorkPrecision::full_grid() const {
  int all = 0;
  for (const Course& course : courses_) all += course.method.levels();
  return all;
}

Sample WorkPrecision::sample_of(const Method& method, int level, const CaseResult& r) const {
  Sample s{level, r.status, r.reason, {}, r.counts, {r.cpu, r.cpu, 1}};
  if (!s.done()) return s;
  s.error = measure_.error(r.series, reference_.trusted_until);
  const bool asks = method.varied == Method::Varied::tolerance;
  s.deceived = asks && s.error.max > std::max(10 * method.asked(level), reference_.floor());
  return s;
}

void WorkPrecision::run(const std::vector<std::pair<std::size_t, int>>& which, double limit) {
  std::vector<Overrides> cases;
  for (const auto& [course, level] : which) cases.push_back(courses_[course].method.overrides(level));
  const std::vector<CaseResult> results = run_(cases, limit);
  runs_ += int(which.size());
  for (std::size_t i = 0; i < which.size(); ++i) {
    Course& course = courses_[which[i].first];
    course.samples[which[i].second] = sample_of(course.method, which[i].second, results[i]);
  }
}

std::optional<std::pair<std::size_t, int>> WorkPrecision::best(double target) const {
  std::optional<std::pair<std::size_t, int>> found;
  double least = infinity;
  for (std::size_t i = 0; i < courses_.size(); ++i)
    for (const auto& [level, s] : courses_[i].samples)
      if (s.done() && s.error.max <= target && s.cpu.least < least) least = s.cpu.least, found = {i, level};
  return found;
}

// Extrapolates from the nearest level that was run, even if that run was stopped as too long.
double WorkPrecision::expected_cost(const Course& course, int level) const {
  if (course.samples.empty()) return 0;
  const auto near = std::min_element(
      course.samples.begin(), course.samples.end(),
      [level](const auto& a, const auto& b) { return std::abs(a.first - level) < std::abs(b.first - level); });
  return near->second.cpu.least * std::pow(10.0, cost_slope(course.method) * (level - near->first));
}

void WorkPrecision::drop_expensive(std::vector<std::pair<std::size_t, int>>& which, double target) {
  const auto found = best(target);
  double least = found ? sample(*found).cpu.least : infinity;
  for (const auto& [i, level] : which)
    if (const double cost = expected_cost(courses_[i], level); cost > 0) least = std::min(least, cost);
  std::erase_if(which, [&](const auto& one) {
    Course& course = courses_[one.first];
    if (!(expected_cost(course, one.second) > too_expensive * least)) return false;
    course.ended = "it is expected to cost more than three times the cheapest";
    return true;
  });
}

std::optional<int> WorkPrecision::next_level(const Course& course, double target) const {
  if (course.samples.empty()) return first_level(course.method, target);
  if (int(course.samples.size()) >= most_runs) return std::nullopt;
  const auto is_long = [](const auto& s) { return s.second.status == CaseResult::Status::too_long; };
  if (std::any_of(course.samples.begin(), course.samples.end(), is_long)) return std::nullopt;
  const Bracket bracket = bracket_of(course, target);
  if (bracket.meets - bracket.fails <= 1) return std::nullopt;
  return std::clamp(int(std::ceil(level_of(target, course, bracket))), bracket.fails + 1, bracket.meets - 1);
}

void WorkPrecision::search(double target) {
  for (;;) {
    std::vector<std::pair<std::size_t, int>> which;
    for (std::size_t i = 0; i < courses_.size(); ++i) {
      Course& course = courses_[i];
      if (!course.ended.empty()) continue;
      const auto level = next_level(course, target);
      if (!level)
        course.ended = "the loosest setting that meets the target is known, or none does";
      else
        which.emplace_back(i, *level);
    }
    drop_expensive(which, target);
    if (which.empty() || run_.left() < left_for_rest * run_.budget() || run_.interrupted()) return;
    const auto found = best(target);
    const double share = run_.left() / double(2 * which.size());
    run(which, found ? std::min(share, 2 * too_expensive * sample(*found).cpu.least + least_limit) : share);
  }
}

void WorkPrecision::scan(int stride) {
  for (int level = 0; level < most_levels; level += stride) {
    std::vector<std::pair<std::size_t, int>> which;
    for (std::size_t i = 0; i < courses_.size(); ++i)
      if (level < courses_[i].method.levels() && courses_[i].ended.empty()) which.emplace_back(i, level);
    if (which.empty() || run_.left() <= 0 || run_.interrupted()) return;
    const double limit = run_.left() / double(2 * which.size());
    run(which, limit);
    for (const auto& [i, at] : which)
      if (courses_[i].samples.at(at).status == CaseResult::Status::too_long)
        courses_[i].ended = "it took longer than its share of the budget";
  }
}

void WorkPrecision::repeat(double target, double factor) {
  const auto found = best(target);
  if (!found) return;
  const double least = sample(*found).cpu.least;
  std::vector<std::pair<std::size_t, int>> front;
  std::vector<Overrides> cases;
  double each = 0;
  for (std::size_t i = 0; i < courses_.size(); ++i)
    for (const auto& [level, s] : courses_[i].samples)
      if (s.done() && s.error.max <= target && s.cpu.least <= factor * least)
        front.emplace_back(i, level), cases.push_back(courses_[i].method.overrides(level)), each += s.cpu.least;
  const double enough = run_.spent() + part_of_repetitions * run_.budget();
  for (int k = 1; k < repetitions && run_.spent() + each < enough && !run_.interrupted(); ++k) {
    const std::vector<CaseResult> results = run_(cases, run_.left());
    for (std::size_t n = 0; n < front.size(); ++n) {
      if (!results[n].done()) continue;
      Timing& t = courses_[front[n].first].samples.at(front[n].second).cpu;
      t.least = std::min(t.least, results[n].cpu), t.most = std::max(t.most, results[n].cpu), ++t.repetitions;
    }
  }
}

}  // namespace trammel::study
