#include "numerics/contact_forces.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/friction_cone.hpp"

namespace trammel::numerics {
namespace {

using Tangent = ContactPoint::Tangent;

// What a variable of the problem belongs to.
struct Held {
  const ContactPoint& point;
  int tangent;
};

}  // namespace

// F = P z + p0 with z = (N, T+, a-): then a = A P z + (A p0 + b).
LcpOutcome solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a) {
  std::vector<const ContactPoint*> unilateral;
  std::vector<Held> held;
  for (const ContactPoint& p : points) {
    if (p.normal >= 0) unilateral.push_back(&p);
    for (int k = 0; p.held() && k < p.tangents; ++k) held.push_back({p, p.tangent + k});
  }
  const Eigen::Index m = b.size(), normals = Eigen::Index(unilateral.size()), tangents = Eigen::Index(held.size()),
                     n = normals + 2 * tangents;
  const auto normal_of = [&](const ContactPoint& p) {
    return std::find(unilateral.begin(), unilateral.end(), &p) - unilateral.begin();
  };
  Mat P = Mat::Zero(m, n), M = Mat::Zero(n, n);
  Vec p0 = Vec::Zero(m), q(n), z, w;
  F.setZero(m);
  a.setZero(m);
  for (Eigen::Index i = 0; i < normals; ++i) {
    const ContactPoint& p = *unilateral[std::size_t(i)];
    P(p.normal, i) = 1;
    for (int k = 0; p.kind == Tangent::sliding && k < p.tangents; ++k) P(p.tangent + k, i) = p.ratio[k];
  }
  for (Eigen::Index i = 0; i < tangents; ++i) {
    const auto& [p, tangent] = held[std::size_t(i)];
    P(tangent, normals + i) = 1;
    if (p.normal >= 0)
      P(tangent, normal_of(p)) = -p.coefficient;
    else
      p0[tangent] = -p.coefficient * p.given;
  }
  const Mat AP = A * P;
  const Vec free = A * p0 + b;
  for (Eigen::Index i = 0; i < normals; ++i) {
    const int normal = unilateral[std::size_t(i)]->normal;
    M.row(i) = AP.row(normal), q[i] = free[normal];
    // Round-off is no stiffness: Painleve's critical coefficient.
    if (std::abs(M(i, i)) <= 1e-12 * A(normal, normal)) M(i, i) = 0;
  }
  for (Eigen::Index i = 0; i < tangents; ++i) {
    const auto& [p, tangent] = held[std::size_t(i)];
    const Eigen::Index iT = normals + i, iS = iT + tangents;  // of T- and a-
    M.row(iT) = AP.row(tangent), q[iT] = free[tangent];
    M(iT, iS) = 1;
    M(iS, iT) = -1;
    if (p.normal >= 0)
      M(iS, normal_of(p)) = 2 * p.coefficient, q[iS] = 0;
    else
      q[iS] = 2 * p.coefficient * p.given;
  }
  const bool cones = std::any_of(held.begin(), held.end(), [](const Held& h) { return h.point.tangents == 2; });
  const LcpOutcome outcome = solve_lcp(M, q, z, w);
  if (cones) {
    if (outcome == LcpOutcome::solved) F = P * z + p0;
    return solve_cones(points, A, b, F, a) ? LcpOutcome::solved : LcpOutcome::no_solution;
  }
  if (outcome != LcpOutcome::solved) return outcome;
  F = P * z + p0;
  a = A * F + b;
  // Accelerations from the complementarity itself where it has them, without the round-off of A F.
  for (Eigen::Index i = 0; i < normals; ++i) a[unilateral[std::size_t(i)]->normal] = w[i];
  for (Eigen::Index i = 0; i < tangents; ++i)
    a[held[std::size_t(i)].tangent] = w[normals + i] - z[normals + i + tangents];
  return outcome;
}

}  // namespace trammel::numerics
