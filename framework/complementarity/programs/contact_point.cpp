#include "complementarity/programs/contact_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::complementarity {
namespace {

using Tangential = Eigen::Vector2d;

// Of the terms of A F, so that their round-off is below `largest_violation`, however much they cancel.
constexpr double share_of_terms = 1e-4;

Tangential part(const Vec& x, const ContactPoint& p) {
  Tangential both = Tangential::Zero();
  both.head(p.tangents) = x.segment(p.tangent, p.tangents);
  return both;
}

double off_law(const ContactPoint& p, const Mat& A, const Vec& F, const Vec& a) {
  double worst = 0, N = p.given;
  if (p.normal >= 0) {
    N = F[p.normal];
    worst = std::abs(std::min(A(p.normal, p.normal) * N, a[p.normal]));
  }
  if (p.tangent < 0 || p.kind == ContactPoint::Tangent::none) return worst;
  const double stiff = A.block(p.tangent, p.tangent, p.tangents, p.tangents).trace() / p.tangents;
  const Tangential T = part(F, p);
  if (p.kind == ContactPoint::Tangent::sliding) {
    Tangential wanted = N * p.ratio;
    wanted.tail(2 - p.tangents).setZero();
    return std::max(worst, stiff * (T - wanted).norm());
  }
  const double bound = p.held() ? p.coefficient * std::max(0.0, N) : 0;
  Tangential pushed = stiff > 0 ? Tangential(T - part(a, p) / stiff) : T;
  if (const double size = pushed.norm(); size > bound) pushed *= bound / size;
  return std::max(worst, stiff * (T - pushed).norm());
}

}  // namespace

double violation(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& F, double nothing) {
  return violation(points, A, b, F, A * F + b, nothing);
}

double violation(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& F, const Vec& a,
                 double nothing) {
  if (b.size() == 0) return 0;
  if (!F.allFinite()) return std::numeric_limits<double>::infinity();
  const double scale = b.lpNorm<Eigen::Infinity>() + share_of_terms * (A.cwiseAbs() * F.cwiseAbs()).maxCoeff() +
                       nothing / largest_violation;
  double worst = 0;
  for (const ContactPoint& p : points) worst = std::max(worst, off_law(p, A, F, a));
  return scale > 0 ? worst / scale : worst;
}

}  // namespace trammel::complementarity
