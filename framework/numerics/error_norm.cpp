#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/error_norm.hpp>

namespace trammel {

double error_norm(const Vec& e_q, const Vec& e_v, const State& now, const State& next, const Tolerance& tolerance) {
  const Eigen::Index n = e_v.size();
  if (n == 0) return 0;
  const bool flat = now.q.size() == n;
  const double all = std::max(now.q.lpNorm<Eigen::Infinity>(), next.q.lpNorm<Eigen::Infinity>());
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double size_q = flat ? std::max(std::abs(now.q[i]), std::abs(next.q[i])) : all;
    const double size_v = std::max(std::abs(now.v[i]), std::abs(next.v[i]));
    const double of_q = e_q[i] / (tolerance.absolute + tolerance.relative * size_q);
    const double of_v = e_v[i] / (tolerance.absolute + tolerance.relative * size_v);
    sum += of_q * of_q + of_v * of_v;
  }
  const double norm = std::sqrt(sum / double(2 * n));
  return std::isfinite(norm) ? norm : std::numeric_limits<double>::infinity();
}

}  // namespace trammel
