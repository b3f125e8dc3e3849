#include "complementarity/programs/polyhedral_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trammel::complementarity {
namespace {

using Tangential = Eigen::Vector2d;

constexpr double no_stiffness = 1e-12;  // of a contact's own: what the terms of its friction leave by round-off

Tangential direction(int k, int betas) {
  const double angle = 2 * std::numbers::pi * k / betas;
  if (betas == 2) return {k == 0 ? 1 : -1, 0};
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

void PolyhedralCone::lay_out(const std::vector<ContactPoint>& points, int sides) {
  for (const ContactPoint& p : points) {
    Place& place = places_.emplace_back();
    if (p.normal >= 0) place.normal = variables_++;
    if (!p.held()) continue;
    place.betas = p.tangents == 1 ? 2 : sides;
    place.first_beta = variables_;
    place.lambda = variables_ + place.betas;
    variables_ += place.betas + 1;
  }
}

// With R the rows of interest (e_n and d_k): M = R (A + compliance) P plus the terms that couple beta and lambda.
PolyhedralCone::PolyhedralCone(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double compliance,
                               int sides) {
  lay_out(points, sides);
  const Eigen::Index m = b.size();
  const double stiff = std::max(A.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  const double largest = b.lpNorm<Eigen::Infinity>() > 0 ? b.lpNorm<Eigen::Infinity>() : 1;
  unit_force_ = largest / stiff;
  P_.setZero(m, variables_);
  Mat R = Mat::Zero(variables_, m);
  M_.setZero(variables_, variables_);
  q_.setZero(variables_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& p = points[i];
    const Place& place = places_[i];
    if (place.normal >= 0) {
      P_(p.normal, place.normal) = R(place.normal, p.normal) = 1;
      if (p.slides()) P_.col(place.normal).segment(p.tangent, p.tangents) += p.ratio.head(p.tangents);
    }
    for (int k = 0; k < place.betas; ++k) {
      const int beta = place.first_beta + k;
      const Tangential d = direction(k, place.betas);
      for (int t = 0; t < p.tangents; ++t) P_(p.tangent + t, beta) = R(beta, p.tangent + t) = d[t];
      M_(beta, place.lambda) = 1;
      M_(place.lambda, beta) = -1;
    }
    if (place.lambda < 0) continue;
    if (place.normal >= 0)
      M_(place.lambda, place.normal) = p.coefficient;
    else
      q_[place.lambda] = p.coefficient * p.given / unit_force_;
  }
  const Mat compliant = A / stiff + compliance * Mat::Identity(m, m);
  M_.noalias() += R * (compliant * P_);
  q_.noalias() += R * (b / largest);
  // Round-off is no stiffness (Painleve's critical coefficient).
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const int N = places_[i].normal;
        N >= 0 && std::abs(M_(N, N)) <= no_stiffness * A(points[i].normal, points[i].normal) / stiff)
      M_(N, N) = 0;
}

}  // namespace trammel::complementarity
