#include "complementarity/contact_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trammel::complementarity {
namespace {

// Irregular weights: sums of different numbers then differ.
constexpr double weights[] = {1,
                              0.7548776662466927,
                              0.5698402909980532,
                              0.4301597090019467,
                              0.3247179572447460,
                              0.2451223337533073,
                              0.1850377087105194};

double relative(double x, double size) {
  return size > 0 ? x / size : 0;
}

// Without units; as logarithms, since masses may differ by many powers of ten.
double own_number(const ContactPoint& p, const Mat& A, double stiff, double load) {
  const auto size = [stiff](double x) { return x > 0 ? std::log(x / stiff) : 0; };
  double number = weights[0] * p.coefficient + weights[1] * p.ratio[0] + weights[2] * p.ratio[1];
  if (p.normal >= 0)
    number += weights[3] * size(A(p.normal, p.normal));
  else
    number += weights[4] * relative(p.given * stiff, load) - 1;
  for (int k = 0; k < p.tangents && p.normal >= 0 && p.tangent >= 0; ++k) {
    const double both = A(p.normal, p.normal) * A(p.tangent + k, p.tangent + k);
    number += weights[5 + k] * relative(A(p.normal, p.tangent + k), std::sqrt(std::max(0.0, both)));
  }
  if (p.tangent >= 0) number += 1 + weights[4] * size(A.block(p.tangent, p.tangent, p.tangents, p.tangents).trace());
  return number;
}

// A number for the entries of a contact in a vector of forces or accelerations.
double entries(const ContactPoint& p, const Vec& x) {
  const double size = x.lpNorm<Eigen::Infinity>();
  double number = p.normal >= 0 ? relative(x[p.normal], size) : 0;
  for (int k = 0; k < p.tangents && p.tangent >= 0; ++k) number += weights[1 + k] * relative(x[p.tangent + k], size);
  return number;
}

}  // namespace

OrderedContacts::OrderedContacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b) {
  const double stiff = std::max(A.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
  const Vec first = A * b / stiff, second = A * first / stiff;
  std::vector<double> numbers;
  for (const ContactPoint& p : points)
    numbers.push_back(own_number(p, A, stiff, b.lpNorm<Eigen::Infinity>()) + entries(p, b) +
                      weights[1] * entries(p, first) + weights[2] * entries(p, second));
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), std::size_t(0));
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) { return numbers[i] < numbers[j]; });
  for (const std::size_t i : order_) {
    ContactPoint& p = points_.emplace_back(points[i]);
    if (p.normal >= 0) {
      rows_.push_back(p.normal);
      p.normal = int(rows_.size()) - 1;
    }
    if (p.tangent < 0) continue;
    for (int k = 0; k < p.tangents; ++k) rows_.push_back(p.tangent + k);
    p.tangent = int(rows_.size()) - p.tangents;
  }
  A_ = A(rows_, rows_);
  b_ = b(rows_);
}

Vec OrderedContacts::as_named(const Vec& x) const {
  Vec named(x.size());
  named(rows_) = x;
  return named;
}

}  // namespace trammel::complementarity
