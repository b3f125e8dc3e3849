#include "study/trade/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace trammel::study {
namespace {

using simulate::ContactEvent;

constexpr int all_starts = 16, fewest = 4;
constexpr double apart = 1e-10;     // largest perturbation of a start (CaseOptions)
constexpr double same_mean = 1e-9;  // relative: round-off of the means of marks that do not spread

// In a fixed order; values that a run does not have are left out.
std::vector<std::pair<std::string, double>> marks_of(const CaseResult& r) {
  std::vector<std::pair<std::string, double>> marks;
  double lost = 0;
  const ContactEvent *first = nullptr, *last = nullptr;
  for (const ContactEvent& e : r.events) {
    lost += e.energy_lost;
    if (e.kind != ContactEvent::Kind::impact) continue;
    if (!first) first = &e;
    last = &e;
  }
  if (first) marks.emplace_back("first impact [s]", first->t);
  if (last) marks.emplace_back("last rebound [m/s]", last->separation);
  if (!r.events.empty()) marks.emplace_back("energy lost in impacts [J]", lost);
  for (std::size_t k = 0; k < r.series.names.size(); ++k) {
    double peak = 0;
    for (std::size_t i = 0; i < r.series.rows(); ++i) peak = std::max(peak, std::abs(r.series.at(i, k)));
    marks.emplace_back("peak of |" + r.series.names[k] + "|", peak);
  }
  return marks;
}

// The number of starts that half of the remaining time pays for, or the fewest if all of it pays for them.
int affordable_starts(double cpu_of_pair, const Runner& run) {
  const int half = int(run.left() / (2 * cpu_of_pair));
  return std::min(all_starts, half < fewest && run.left() > fewest * cpu_of_pair ? fewest : half);
}

struct Sum {
  std::vector<double> values;
  double mean() const {
    double sum = 0;
    for (const double x : values) sum += x;
    return sum / double(values.size());
  }
  double spread() const {
    const double m = mean();
    double squares = 0;
    for (const double x : values) squares += (x - m) * (x - m);
    return values.size() > 1 ? std::sqrt(squares / double(values.size() - 1)) : 0;
  }
};

}  // namespace

bool Distribution::alike() const {
  const double error = std::sqrt((spread * spread + reference_spread * reference_spread) / std::max(starts, 1));
  return std::abs(mean - reference_mean) <= 2 * error + same_mean * std::abs(reference_mean);
}

std::vector<Distribution> compare_ensembles(const Overrides& choice, double choice_cpu, const Overrides& reference,
                                            double reference_cpu, const Measure& measure, Runner& run) {
  const int starts = affordable_starts(choice_cpu + reference_cpu, run);
  if (starts < fewest || measure.reference().series.rows() == 0) return {};
  std::vector<std::string> order;
  std::map<std::string, std::pair<Sum, Sum>> sums;
  for (int k = 0; k < starts && !run.interrupted(); ++k) {
    const double perturbation = apart * (2.0 * (k + 1) / starts - 1);
    const std::vector<CaseResult> results = run({choice, reference}, run.left(), perturbation);
    if (!results[0].done() || !results[1].done()) continue;
    for (const bool of_choice : {true, false})
      for (const auto& [what, x] : marks_of(results[of_choice ? 0 : 1])) {
        if (!sums.contains(what)) order.push_back(what);
        auto& [ours, theirs] = sums[what];
        (of_choice ? ours : theirs).values.push_back(x);
      }
  }
  std::vector<Distribution> all;
  for (const std::string& what : order) {
    const auto& [ours, theirs] = sums[what];
    if (ours.values.empty() || theirs.values.empty()) continue;
    all.push_back({what, ours.mean(), ours.spread(), theirs.mean(), theirs.spread(), int(ours.values.size())});
  }
  return all;
}

}  // namespace trammel::study
