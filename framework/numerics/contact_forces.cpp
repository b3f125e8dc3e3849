#include "numerics/contact_forces.hpp"

#include <cmath>

namespace trammel::numerics {
namespace {

using Tangent = ContactPoint::Tangent;

// A bound of 0: no force, whatever the acceleration.
bool bound(const ContactPoint& p) {
  return p.kind == Tangent::resting && p.coefficient > 0 && (p.normal >= 0 || p.given > 0);
}

}  // namespace

// F = P z + p0 with z = (N, T+, a-): then a = A P z + (A p0 + b).
LcpOutcome solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a) {
  const Eigen::Index m = b.size();
  Eigen::Index unilateral = 0, resting = 0;
  for (const ContactPoint& p : points) unilateral += p.normal >= 0, resting += bound(p);
  const Eigen::Index n = unilateral + 2 * resting;
  Mat P = Mat::Zero(m, n), M = Mat::Zero(n, n);
  Vec p0 = Vec::Zero(m), q(n), z, w;
  F.setZero(m);
  a.setZero(m);
  Eigen::Index iN = 0, iT = unilateral;
  for (const ContactPoint& p : points) {
    if (p.normal >= 0) {
      P(p.normal, iN) = 1;
      if (p.kind == Tangent::sliding) P(p.tangent, iN) = p.coefficient;
      if (bound(p)) P(p.tangent, iN) = -p.coefficient;
    }
    if (bound(p)) {
      P(p.tangent, iT) = 1;
      if (p.normal < 0) p0[p.tangent] = -p.coefficient * p.given;
      ++iT;
    }
    iN += p.normal >= 0;
  }
  const Mat AP = A * P;
  const Vec free = A * p0 + b;
  iN = 0, iT = unilateral;
  for (const ContactPoint& p : points) {
    if (p.normal >= 0) {
      M.row(iN) = AP.row(p.normal), q[iN] = free[p.normal];
      // Round-off is no stiffness: Painleve's critical coefficient.
      if (std::abs(M(iN, iN)) <= 1e-12 * A(p.normal, p.normal)) M(iN, iN) = 0;
    }
    if (bound(p)) {
      const Eigen::Index iS = iT + resting;  // of T- and a-
      M.row(iT) = AP.row(p.tangent), q[iT] = free[p.tangent];
      M(iT, iS) = 1;
      M(iS, iT) = -1;
      if (p.normal >= 0)
        M(iS, iN) = 2 * p.coefficient, q[iS] = 0;
      else
        q[iS] = 2 * p.coefficient * p.given;
      ++iT;
    }
    iN += p.normal >= 0;
  }
  const LcpOutcome outcome = solve_lcp(M, q, z, w);
  if (outcome != LcpOutcome::solved) return outcome;
  F = P * z + p0;
  a = A * F + b;
  // Accelerations from the complementarity itself where it has them, without the round-off of A F.
  iN = 0, iT = unilateral;
  for (const ContactPoint& p : points) {
    if (p.normal >= 0) a[p.normal] = w[iN];
    if (bound(p)) a[p.tangent] = w[iT] - z[iT + resting], ++iT;
    iN += p.normal >= 0;
  }
  return outcome;
}

}  // namespace trammel::numerics
