#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/methods/error_norm.hpp>

#include "linear/dense/eps.hpp"

namespace trammel {
namespace {

// Methods of order 8 that keep errors of about 1e-9 have the longest steps: half the amplitude of an oscillation.
// Shorter steps are judged more strictly.
constexpr double steps_in_a_motion = 2;
// Rows that are stabilised at about this rate [1/s] turn round-off of coordinates into accelerations.
constexpr double stabilised = 1;

double largest_of(const Vec& a, const Vec& b) {
  return a.size() ? std::max(a.lpNorm<Eigen::Infinity>(), b.lpNorm<Eigen::Infinity>()) : 0;
}

}  // namespace

double error_norm(const Vec& e_q, const Vec& e_v, const State& now, const State& next, const Tolerance& tolerance) {
  const Eigen::Index n = e_v.size();
  if (n == 0) return 0;
  const double ahead = steps_in_a_motion * (next.t - now.t);
  const bool flat = now.q.size() == n;
  const double all_q = largest_of(now.q, next.q), round_off_q = 4 * eps * all_q;
  const double round_off_v = 4 * eps * largest_of(now.v, next.v);
  const double absolute_v = std::max({tolerance.absolute, tolerance.absolute_rate, stabilised * round_off_q});
  if (tolerance.parts) tolerance.parts->resize(n);
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double size_v = std::max(std::abs(now.v[i]), std::abs(next.v[i]));
    const double entry = flat ? std::max(std::abs(now.q[i]), std::abs(next.q[i])) : all_q;
    const double size_q = std::min(entry, ahead * size_v);  // a step may be many oscillations long
    const double allowed_q = tolerance.absolute + tolerance.relative * size_q + round_off_q;
    const double allowed_v = absolute_v + tolerance.relative * size_v + round_off_v;
    const double of_q = e_q[i] != 0 ? e_q[i] / allowed_q : 0;
    const double of_v = e_v[i] != 0 ? e_v[i] / allowed_v : 0;
    sum += of_q * of_q, sum += of_v * of_v;
    if (tolerance.parts) (*tolerance.parts)[i] = of_q * of_q + of_v * of_v;
  }
  const double norm = std::sqrt(sum / double(2 * n));
  return std::isfinite(norm) ? norm : std::numeric_limits<double>::infinity();
}

}  // namespace trammel
