// The end of an impact: energy left in springs is lost, remaining approaches are stopped without restitution.
#include "simulate/impact/spring_impact.hpp"

#include <algorithm>
#include <cmath>

#include "complementarity/shares/admissible_forces.hpp"
#include "complementarity/shares/row_basis.hpp"

namespace trammel::simulate {

using complementarity::ContactPoint;
using complementarity::ContactSolution;
using complementarity::LcpOutcome;

namespace {

constexpr double compliance = 1e-9;    // of the largest entry of A
constexpr double outside_cone = 1e-9;  // of its bound: beyond the round-off of a contact that slides

}  // namespace

ContactSolution SpringImpact::close() {
  taken_at_end_ = k_ / 2 * x_.squaredNorm();
  lost_normal_ += k_ / 2 * x_.cwiseAbs2();
  for (Eigen::Index i = 0; i < n_; ++i)
    if (const Contact& c = contacts_[std::size_t(i)]; c.compresses)
      compressed_[i] += k_ / 2 * (x_[i] * x_[i] - c.x_0 * c.x_0);
  x_.setZero();
  for (const double yields : {compliance, compliance, 0.0}) {
    const double closing = fastest_approach();
    if (closing <= (yields > 0 ? tolerance : still) * v_) break;
    const ContactSolution solution = end_approaches(yields);
    if (yields == 0 && solution.outcome != LcpOutcome::solved) return solution;
  }
  share_sticking_forces();
  return {LcpOutcome::solved, 0};
}

double SpringImpact::fastest_approach() const {
  const Vec u = rates();
  double fastest = 0;
  for (const Contact& c : contacts_) fastest = std::max(fastest, -u[c.normal]);
  return fastest;
}

// An impact without restitution, with friction if that has a solution. `yields`: compliance of a contact, relative to
// the largest entry of A, so that round-off in the rates of dependent contacts is no contradiction.
ContactSolution SpringImpact::end_approaches(double yields) {
  const Vec u = rates();
  const Mat A = A_ + yields * A_.diagonal().maxCoeff() * Mat::Identity(m_, m_);
  std::vector<ContactPoint> points;
  for (const Contact& c : contacts_) {
    ContactPoint& p = points.emplace_back();
    p.normal = c.normal;
    if (!(c.mu_0 > 0) || c.tangent < 0) continue;
    p.tangent = c.tangent, p.tangents = t_, p.coefficient = c.mu_0;
    p.kind = ContactPoint::Tangent::resting;
  }
  Vec P, a;
  ContactSolution solution = complementarity::solve_contacts(points, A, u, P, a);
  if (solution.outcome != LcpOutcome::solved) {
    for (ContactPoint& p : points) p.kind = ContactPoint::Tangent::none;
    solution = complementarity::solve_contacts(points, A, u, P, a);
  }
  if (solution.outcome != LcpOutcome::solved) return solution;
  const Vec mean = u + 0.5 * A_ * P;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const Contact& c = contacts_[std::size_t(i)];
    taken_at_end_ += std::abs(P[c.normal] * mean[c.normal]);
    lost_normal_[i] -= P[c.normal] * mean[c.normal];
    if (c.tangent >= 0) lost_friction_[i] -= P.segment(c.tangent, t_).dot(mean.segment(c.tangent, t_));
  }
  P_ += P;
  return solution;
}

// The friction impulses of contacts that stick together are not unique. If they leave a friction cone, takes the
// admissible impulses of least norm.
void SpringImpact::share_sticking_forces() {
  admissible_ = P_;
  for (const Contact& c : contacts_) admissible_[c.normal] = std::max(0.0, P_[c.normal]);  // negative by round-off only
  bool outside = false;
  std::vector<Eigen::Index> rows;
  for (const Contact& c : contacts_) {
    if (c.tangent < 0 || c.mu_0 == 0) continue;
    outside =
        outside || admissible_.segment(c.tangent, t_).norm() > c.mu_0 * admissible_[c.normal] * (1 + outside_cone);
    for (int k = 0; k < t_; ++k) rows.push_back(c.tangent + k);
  }
  if (!outside) return;
  const complementarity::RowBasis basis = complementarity::find_basis(A_, rows);
  std::vector<Eigen::Index> order_of = basis.basis;
  order_of.insert(order_of.end(), basis.implied.begin(), basis.implied.end());
  std::vector<complementarity::SharingContact> sharing;
  for (const Contact& c : contacts_) {
    if (c.tangent < 0 || c.mu_0 == 0) continue;
    complementarity::SharingContact& s = sharing.emplace_back();
    for (int k = 0; k < t_; ++k)
      s.tangents.push_back(std::find(order_of.begin(), order_of.end(), c.tangent + k) - order_of.begin());
    s.coefficient = c.mu_0, s.given = admissible_[c.normal];
  }
  const Mat E = basis.resultants();
  Vec shared;
  complementarity::admissible_forces(sharing, E, E * P_(order_of), shared);
  Vec shared_all = admissible_;
  for (std::size_t i = 0; i < order_of.size(); ++i) shared_all[order_of[i]] = shared[Eigen::Index(i)];
  if ((A_ * (shared_all - P_)).lpNorm<Eigen::Infinity>() <= still * v_) admissible_ = shared_all;
}

}  // namespace trammel::simulate
