#include "simulate/impact.hpp"

#include "numerics/lcp.hpp"

namespace trammel::simulate {

bool Impact::solve(model::AssembledSystem& system, std::vector<TouchingContact>& touching, Vec& dv) {
  const auto n = Eigen::Index(touching.size());
  contacts_.clear();
  for (const TouchingContact& c : touching) contacts_.push_back(c.contact);
  system.impulse_response(contacts_, jump_, delassus_);
  q_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i)
    q_[i] = touching[i].was_closed ? 0 : (1 + touching[i].restitution) * touching[i].before;
  if (numerics::solve_lcp(delassus_, q_, impulses_, slack_) != numerics::LcpOutcome::solved) return false;
  dv.noalias() = jump_ * impulses_;
  for (Eigen::Index i = 0; i < n; ++i) {
    TouchingContact& c = touching[i];
    c.impulse = impulses_[i];
    // From the complementarity itself where the impulse acts: -e u- exactly, without the round-off of D L.
    c.after = impulses_[i] > 0 ? (c.was_closed ? c.before : -c.restitution * c.before)
                               : c.before + delassus_.row(i).dot(impulses_);
  }
  return true;
}

}  // namespace trammel::simulate
