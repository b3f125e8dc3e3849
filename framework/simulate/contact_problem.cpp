#include "simulate/contact_problem.hpp"

#include <cmath>

#include <Eigen/QR>

namespace trammel::simulate {

void ContactProblem::prepare(model::AssembledSystem& system) {
  directions_.clear();
  points_.clear();
  for (const Participant& p : who) {
    numerics::ContactPoint point;
    if (p.unilateral) point.normal = int(directions_.size()), directions_.push_back({p.contact, 0});
    if (p.tangent != Participant::Tangent::none)
      point.tangent = int(directions_.size()), directions_.push_back({p.contact, 1});
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
      point.kind = numerics::ContactPoint::Tangent::sliding, point.coefficient = p.ratio;
  }
  return numerics::solve_contacts(points_, delassus_, b_, F_, a_) == numerics::LcpOutcome::solved;
}

bool ContactProblem::solve(double nothing) {
  b_.resize(Eigen::Index(directions_.size()));
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (points_[i].normal >= 0) b_[points_[i].normal] = who[i].a_n;
    if (points_[i].tangent >= 0) b_[points_[i].tangent] = who[i].a_t;
  }
  for (bool settled = false; !settled;) {
    if (!solve_once()) return false;
    settled = true;
    for (std::size_t i = 0; i < who.size(); ++i) {
      Participant& p = who[i];
      if (p.tangent != Participant::Tangent::resting || p.let_go || std::abs(a_[points_[i].tangent]) <= nothing)
        continue;
      p.let_go = true;
      if (p.mu < p.mu_0) settled = false;
    }
  }
  for (std::size_t i = 0; i < who.size(); ++i) {
    Participant& p = who[i];
    p.N = p.given;
    if (points_[i].normal >= 0) p.N = F_[points_[i].normal], p.a_n = a_[points_[i].normal];
    if (points_[i].tangent >= 0) p.T = F_[points_[i].tangent], p.a_t = a_[points_[i].tangent];
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
    held.push_back(points_[i].tangent);
    slip[points_[i].tangent] = who[i].a_t;
  }
  const Mat A = delassus_(held, held);
  const Vec impulses = A.completeOrthogonalDecomposition().solve(-slip(held));
  dv.noalias() = jump_(Eigen::all, held) * impulses;
}

}  // namespace trammel::simulate
