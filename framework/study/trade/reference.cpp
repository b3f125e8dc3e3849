#include "study/trade/reference.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace trammel::study {
namespace {

constexpr double loosest = loosest_reference, tightest = 1e-13, tighter = 1e-2;
constexpr double tie = 1e-9;  // [s] of agreement per relative error: decides between those that agree equally long

class ReferenceSearch {
 public:
  ReferenceSearch(const Methods& methods, Runner& run, double target, const std::vector<std::string>& observed)
      : run_(run), target_(target), observed_(observed), scene_(run.source().with()) {
    for (const Method& method : methods.capable)
      if (method.varied == Method::Varied::tolerance) candidates_.push_back(method);
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Method& a, const Method& b) { return a.order > b.order; });
  }

  std::optional<TradeReference> operator()(std::string& why) {
    begin();
    if (!choose(why)) return std::nullopt;
    tighten();
    TradeReference found = judged();
    constexpr int fewest = 5;
    const Series& s = found.first.result.series;
    const auto compared = std::count_if(s.t.begin(), s.t.end(), [&](double t) { return t <= found.trusted_until; });
    if (compared >= std::min<long>(fewest, long(s.rows()))) return found;
    why = fmt::format(
        "{} (tolerance {:.2g}) and {} (tolerance {:.2g}) agree within a tenth of the target until t = {:.6g} s only",
        found.first.method.name, found.first.tolerance, found.second.method.name, found.second.tolerance,
        found.trusted_until);
    return std::nullopt;
  }

 private:
  // Runs the method of highest order of each family, at a moderate tolerance: first the families of high order, the
  // others if fewer than two of those reach the end.
  void begin() {
    constexpr int high = 4;
    try_families([](const Method& method) { return method.order >= high; });
    const auto came = std::count_if(tried_.begin(), tried_.end(), [](const auto& r) { return r.result.done(); });
    if (came < 2) try_families([](const Method& method) { return method.order < high; });
  }

  template <class Which>
  void try_families(Which which) {
    std::set<std::string> taken;
    for (const ReferenceRun& one : tried_)
      if (one.result.done()) taken.insert(one.method.family);
    std::vector<Overrides> cases;
    const std::size_t before = tried_.size();
    for (const Method& method : candidates_)
      if (which(method) && taken.insert(method.family).second)
        tried_.push_back({method, loosest, {}}), cases.push_back(at(method, loosest));
    std::vector<CaseResult> results = run_(cases, run_.budget() / 12);
    for (std::size_t i = 0; i < results.size(); ++i) tried_[before + i].result = std::move(results[i]);
  }

  static Overrides at(const Method& method, double tolerance) {
    return {{"integrator", method.with_tolerance(tolerance)}};
  }

  // Chooses the method of highest order that reached the end, then the one of another family that agrees best with it.
  bool choose(std::string& why) {
    std::string reasons;
    for (const ReferenceRun& one : tried_) {
      if (!one.result.done()) {
        reasons += fmt::format("; {}: {}", one.method.name, one.result.reason);
        continue;
      }
      if (!first_) first_ = one;
    }
    if (!first_) return why = "no method reached the end of the scene" + reasons, false;
    const Measure measure(first_->result, observed_, scene_);
    double best = -1;
    for (const ReferenceRun& one : tried_) {
      if (!one.result.done() || one.method.family == first_->method.family) continue;
      const double agreed = measure.agree_until(one.result.series, first_->result.series, target_ / 10);
      const double off = measure.error(one.result.series, agreed).max;
      // Agreement for longer is better; then closer agreement.
      const double merit = agreed - tie * off;
      if (merit > best) best = merit, second_ = one;
    }
    if (second_) return true;
    why = fmt::format("only {} reached the end, and no method of another family confirms it{}", first_->method.name,
                      reasons);
    return false;
  }

  void tighten() {
    TradeReference best = compared();
    while (first_->tolerance > tightest && (best.chaotic || best.disagreement > 0.001 * target_)) {
      const double tolerance = std::max(tightest, first_->tolerance * tighter);
      // Cost grows with the tolerance to the power -1/(order + 1).
      const auto more = [&](const ReferenceRun& r) {
        return r.result.cpu * std::pow(r.tolerance / tolerance, 1.0 / (r.method.order + 1));
      };
      if (more(*first_) + more(*second_) > run_.budget() / 4 - run_.spent()) break;
      std::vector<CaseResult> results =
          run_({at(first_->method, tolerance), at(second_->method, tolerance)}, run_.budget() / 4);
      if (!results[0].done() || !results[1].done()) break;
      const std::optional<ReferenceRun> before_first = first_, before_second = second_;
      first_->tolerance = second_->tolerance = tolerance;
      first_->result = std::move(results[0]), second_->result = std::move(results[1]);
      const TradeReference now = compared();
      if (worse(now, best)) {
        first_ = before_first, second_ = before_second;
        break;
      }
      best = now;
    }
  }

  static bool worse(const TradeReference& now, const TradeReference& best) {
    if (now.trusted_until != best.trusted_until) return now.trusted_until < best.trusted_until;
    return now.disagreement >= best.disagreement;
  }

  TradeReference compared() const {
    TradeReference r;
    const Measure measure(first_->result, observed_, scene_);
    const Series &a = first_->result.series, &b = second_->result.series;
    r.trusted_until = measure.agree_until(a, b, target_ / 10);
    r.differ_at = measure.agree_until(a, b, target_);
    r.chaotic = r.differ_at < measure.end();
    r.disagreement = measure.error(b, a, r.trusted_until).max;
    return r;
  }

  TradeReference judged() const {
    TradeReference r = compared();
    r.first = *first_, r.second = *second_;
    return r;
  }

  Runner& run_;
  double target_;
  const std::vector<std::string>& observed_;
  scene::Scene scene_;
  std::vector<Method> candidates_;
  std::vector<ReferenceRun> tried_;
  std::optional<ReferenceRun> first_, second_;
};

}  // namespace

std::optional<TradeReference> find_reference(const Methods& methods, Runner& run, double target,
                                             const std::vector<std::string>& observed, std::string& why) {
  return ReferenceSearch(methods, run, target, observed)(why);
}

}  // namespace trammel::study
