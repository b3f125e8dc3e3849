#include "testing/difference.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace trammel {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int halvings = 10;

}  // namespace

Difference difference(const std::function<Vec(double)>& f, double h) {
  std::array<Vec, halvings> row, above;
  Difference d;
  d.h = h;
  double s = h;
  for (int j = 0; j < halvings; ++j, s /= 2) {
    const Vec plus = f(s), minus = f(-s);
    if (j == 0) {
      d.value = d.round_off = Vec::Zero(plus.size());
      d.error = Vec::Constant(plus.size(), std::numeric_limits<double>::infinity());
    }
    if (plus.size()) d.size = std::max({d.size, plus.cwiseAbs().maxCoeff(), minus.cwiseAbs().maxCoeff()});
    row[0] = (plus - minus) / (2 * s);
    double factor = 1;
    for (int i = 1; i <= j; ++i) {
      factor *= 4;
      const auto at = std::size_t(i);
      row[at] = (factor * row[at - 1] - above[at - 1]) / (factor - 1);
      for (Eigen::Index k = 0; k < d.value.size(); ++k) {
        const double error = std::max(std::abs(row[at](k) - row[at - 1](k)), std::abs(row[at](k) - above[at - 1](k)));
        if (error < d.error(k)) d.error(k) = error, d.value(k) = row[at](k), d.round_off(k) = eps / s;
      }
    }
    std::swap(row, above);
  }
  d.round_off *= d.size;
  return d;
}

void Comparison::derivative(const Vec& claimed, const Difference& d, const std::string& where, double noise) {
  if (claimed.size() != d.value.size())
    return holds(false, fmt::format("{}: {} entries, expected {}", where, claimed.size(), d.value.size()));
  if (!claimed.size()) return;
  // The change of the function: the scale of the accuracy that the extrapolation can reach.
  const double scale = d.value.cwiseAbs().maxCoeff() + claimed.cwiseAbs().maxCoeff() + d.size / d.h;
  for (Eigen::Index k = 0; k < claimed.size(); ++k) {
    if (!(d.error(k) <= 1e-5 * scale + 1e-300))
      return holds(false,
                   fmt::format("{}, entry {}: differences do not converge ({:.6g} with error {:.1e}): not smooth, "
                               "or tried over too large a range",
                               where, k, d.value(k), d.error(k)));
    // Two columns of the extrapolation may agree by chance: an error below 1e-11 of the change proves nothing.
    const double allowed = 20 * d.error(k) + 16 * d.round_off(k) + 1e-11 * scale + noise + 1e-300;
    keep(std::abs(claimed(k) - d.value(k)) / allowed, [&] {
      return fmt::format("{}, entry {}: {:.10g}, by differences {:.10g} within {:.1e}", where, k, claimed(k),
                         d.value(k), allowed);
    });
  }
}

void Comparison::within(double found, double expected, double allowed, const std::string& where) {
  keep(std::abs(found - expected) / (allowed + 1e-300),
       [&] { return fmt::format("{}: {:.17g}, expected {:.17g} within {:.1e}", where, found, expected, allowed); });
}

void Comparison::within(const Mat& found, const Mat& expected, double allowed, const std::string& where) {
  if (found.rows() != expected.rows() || found.cols() != expected.cols())
    return holds(false, fmt::format("{}: {} x {}, expected {} x {}", where, found.rows(), found.cols(), expected.rows(),
                                    expected.cols()));
  for (Eigen::Index j = 0; j < found.cols(); ++j)
    for (Eigen::Index i = 0; i < found.rows(); ++i)
      within(found(i, j), expected(i, j), allowed, fmt::format("{}, entry ({}, {})", where, i, j));
}

void Comparison::holds(bool true_, const std::string& found) {
  if (!true_) keep(std::numeric_limits<double>::infinity(), [&] { return found; });
}

void Comparison::keep(double ratio, const std::function<std::string()>& text) {
  if (std::isnan(ratio)) ratio = std::numeric_limits<double>::infinity();
  if (!(ratio > worst_)) return;
  worst_ = ratio;
  worst_text_ = text();
}

Report Comparison::report() const {
  Report report;
  report.claim(claim_, worst_ <= 1, worst_ <= 1 ? "" : worst_text_);
  return report;
}

Report compare(const std::string& claim, const std::function<void(Comparison&)>& fill) {
  Comparison comparison(claim);
  fill(comparison);
  return comparison.report();
}

}  // namespace trammel
