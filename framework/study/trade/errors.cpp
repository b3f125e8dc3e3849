#include "study/trade/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::study {
namespace {

// An observable is a constant of the motion if its variation is less than `constant` times its size, and the round-off
// of 0 if it is smaller than `nothing` times the largest one.
constexpr double constant = 1e-6, nothing = 1e-8;

// By the path that the scene records: contacts.tip.force, joints.pin.reaction, beam.tip.ay.
bool is_multiplier(const scene::Scene& scene, const std::string& name) {
  const scene::Value* what = scene.root().at_path("record.observe");
  what = what ? what->find(name) : nullptr;
  if (!what || what->type() != scene::Value::Type::text) return false;
  const std::string& text = what->text();
  return text.ends_with(".force") || text.ends_with(".reaction") || text.ends_with(".alpha") || text.ends_with(".ax") ||
         text.ends_with(".ay") || text.ends_with(".az");
}

std::vector<bool> rows_at_impacts(const CaseResult& r) {
  constexpr double near = 0.01;  // of the distance of records
  std::vector<bool> at(r.series.rows(), false);
  for (const simulate::ContactEvent& event : r.events) {
    const auto after = std::lower_bound(r.series.t.begin(), r.series.t.end(), event.t);
    const std::size_t k = std::size_t(after - r.series.t.begin());
    if (k == 0 || k >= at.size()) continue;
    const double distance = r.series.t[k] - r.series.t[k - 1];
    if (r.series.t[k] - event.t < near * distance) at[k] = true;
    if (event.t - r.series.t[k - 1] < near * distance) at[k - 1] = true;
  }
  return at;
}

}  // namespace

Measure::Measure(const CaseResult& reference, const std::vector<std::string>& observed, const scene::Scene& scene)
    : reference_(reference), at_impact_(rows_at_impacts(reference)) {
  const Series& s = reference_.series;
  for (std::size_t k = 0; k < s.names.size(); ++k) {
    double range = 0, most = 0;
    for (std::size_t i = 0; i < s.rows(); ++i)
      range = std::max(range, std::abs(s.at(i, k) - s.at(0, k))), most = std::max(most, std::abs(s.at(i, k)));
    scales_.push_back(range > constant * most ? range : most > 0 ? most : 1);
    if (!observed.empty() && std::find(observed.begin(), observed.end(), s.names[k]) == observed.end()) continue;
    (is_multiplier(scene, s.names[k]) ? multipliers_ : columns_).push_back(k);
  }
  const double largest = *std::max_element(scales_.begin(), scales_.end());
  for (double& scale : scales_) scale = std::max(scale, nothing * largest);
  if (columns_.empty()) columns_ = multipliers_;  // only multipliers are observed
}

double Measure::off(const Series& a, const Series& b, std::size_t row, std::size_t column) const {
  const double difference = std::abs(a.at(row, column) - b.at(row, column)) / scales_[column];
  return difference == difference ? difference : infinity;
}

Error Measure::error(const Series& a, const Series& b, double until) const {
  Error e;
  double squares = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < reference_.series.rows() && reference_.series.t[i] <= until; ++i) {
    if (i >= a.rows() || i >= b.rows()) return {infinity, infinity, infinity, "", reference_.series.t[i]};
    if (at_impact_[i]) continue;
    for (const std::size_t k : columns_) {
      const double x = off(a, b, i, k);
      if (x > e.max) e.max = x, e.worst = reference_.series.names[k], e.t = reference_.series.t[i];
      squares += x * x, ++counted;
    }
    for (const std::size_t k : multipliers_) e.multipliers = std::max(e.multipliers, off(a, b, i, k));
  }
  if (counted > 0) e.rms = std::sqrt(squares / double(counted));
  return e;
}

double Measure::agree_until(const Series& a, const Series& b, double limit) const {
  double t = reference_.series.t.front();
  for (std::size_t i = 0; i < reference_.series.rows(); ++i) {
    if (i >= a.rows() || i >= b.rows()) return t;
    if (!at_impact_[i])
      for (const std::size_t k : columns_)
        if (off(a, b, i, k) > limit) return t;
    t = reference_.series.t[i];
  }
  return t;
}

}  // namespace trammel::study
