#include "simulate/contact_problem.hpp"

#include <cmath>

#include <Eigen/QR>

namespace trammel::simulate {
namespace {

// The part of x that belongs to the tangents of a contact.
Eigen::VectorBlock<Vec> along(Vec& x, const numerics::ContactPoint& p) {
  return x.segment(p.tangent, p.tangents);
}

}  // namespace

void ContactProblem::prepare(model::AssembledSystem& system) {
  directions_.clear();
  points_.clear();
  for (const Participant& p : who) {
    numerics::ContactPoint point;
    if (p.unilateral) point.normal = int(directions_.size()), directions_.push_back({p.contact, 0});
    if (p.tangent != Participant::Tangent::none) {
      point.tangent = int(directions_.size()), point.tangents = system.tangents();
      for (int k = 0; k < point.tangents; ++k) directions_.push_back({p.contact, 1 + k});
    }
    points_.push_back(point);
  }
  system.impulse_response(directions_, jump_, delassus_);
}

bool ContactProblem::solve_once() {
  for (std::size_t i = 0; i < who.size(); ++i) {
    const Participant& p = who[i];
    numerics::ContactPoint& point = points_[i];
    point.given = p.given;
    if (p.tangent == Participant::Tangent::resting)
      point.kind = numerics::ContactPoint::Tangent::resting, point.coefficient = p.let_go ? p.mu : p.mu_0;
    else if (p.tangent == Participant::Tangent::sliding)
      point.kind = numerics::ContactPoint::Tangent::sliding, point.ratio = p.ratio;
  }
  return numerics::solve_contacts(points_, delassus_, b_, F_, a_) == numerics::LcpOutcome::solved;
}

bool ContactProblem::solve(double nothing) {
  b_.resize(Eigen::Index(directions_.size()));
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (points_[i].normal >= 0) b_[points_[i].normal] = who[i].a_n;
    if (points_[i].tangent >= 0) along(b_, points_[i]) = who[i].a_t.head(points_[i].tangents);
  }
  for (bool settled = false; !settled;) {
    if (!solve_once()) return false;
    settled = true;
    for (std::size_t i = 0; i < who.size(); ++i) {
      Participant& p = who[i];
      if (p.tangent != Participant::Tangent::resting || p.let_go || along(a_, points_[i]).norm() <= nothing) continue;
      p.let_go = true;
      if (p.mu < p.mu_0) settled = false;
    }
  }
  for (std::size_t i = 0; i < who.size(); ++i) {
    Participant& p = who[i];
    p.N = p.given;
    if (points_[i].normal >= 0) p.N = F_[points_[i].normal], p.a_n = a_[points_[i].normal];
    if (const int n = points_[i].tangents; points_[i].tangent >= 0)
      p.T.head(n) = along(F_, points_[i]), p.a_t.head(n) = along(a_, points_[i]);
  }
  return true;
}

void ContactProblem::jump(Vec& dv) const {
  dv.noalias() = jump_ * F_;
}

void ContactProblem::end_slip(Vec& dv) const {
  std::vector<Eigen::Index> held;
  Vec slip = Vec::Zero(Eigen::Index(directions_.size()));
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (points_[i].normal >= 0) held.push_back(points_[i].normal);
    if (who[i].tangent != Participant::Tangent::resting) continue;
    for (int k = 0; k < points_[i].tangents; ++k) held.push_back(points_[i].tangent + k);
    along(slip, points_[i]) = who[i].a_t.head(points_[i].tangents);
  }
  const Mat A = delassus_(held, held);
  const Vec impulses = A.completeOrthogonalDecomposition().solve(-slip(held));
  dv.noalias() = jump_(Eigen::all, held) * impulses;
}

}  // namespace trammel::simulate
