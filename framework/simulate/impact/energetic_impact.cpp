#include "simulate/impact/energetic_impact.hpp"

#include <algorithm>

#include <trammel/decompositions.hpp>

#include "simulate/impact/spring_impact.hpp"

namespace trammel::simulate {

namespace {

constexpr double stopped = 1e-3;  // of the largest vanishing approach: above errors of the course

}  // namespace

complementarity::ContactSolution EnergeticImpact::solve(model::AssembledSystem& system,
                                                        std::vector<TouchingContact>& touching, Vec& dv) {
  directions_.prepare(system, touching);
  add_approaches(touching, 1, directions_.rates);
  std::vector<SpringContact> springs;
  for (std::size_t i = 0; i < touching.size(); ++i)
    springs.push_back({directions_.normal[i], directions_.tangent[i], touching[i].restitution,
                       directions_.friction[i].mu_0, directions_.friction[i].mu});
  SpringImpact impact(springs, directions_.A, directions_.rates, directions_.tangents);
  const complementarity::ContactSolution solution = impact.run();
  cut_short_ = impact.cut_short();
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  Vec P = impact.admissible_impulses(), u = impact.rates();
  dv.noalias() = directions_.jump * impact.impulses();
  let_approaches_vanish(touching, P, u, dv);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    TouchingContact& c = touching[i];
    const int n = directions_.normal[i], t = directions_.tangent[i];
    c.impulse = P[n];
    c.after = (c.was_closed ? c.before : 0) + u[n];
    c.friction.setZero();
    c.slip_after.setZero();
    if (t >= 0) {
      c.friction.head(directions_.tangents) = P.segment(t, directions_.tangents);
      c.slip_after.head(directions_.tangents) = u.segment(t, directions_.tangents);
    }
    const auto at = Eigen::Index(i);
    c.course = impact.lost_normal()[at] + impact.lost_friction()[at] - c.loss_at_mean_rates();
  }
  return solution;
}

void EnergeticImpact::add_approaches(const std::vector<TouchingContact>& touching, double times, Vec& rates) const {
  for (std::size_t i = 0; i < touching.size(); ++i) rates[directions_.normal[i]] += times * touching[i].approach;
}

void EnergeticImpact::let_approaches_vanish(const std::vector<TouchingContact>& touching, Vec& P, Vec& u,
                                            Vec& dv) const {
  double approach = 0;
  for (const TouchingContact& c : touching) approach = std::max(approach, -c.approach);
  const double at_rest = stopped * approach;
  std::vector<Eigen::Index> held;
  bool any = false;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    any = any || touching[i].without_collision;
    const int n = directions_.normal[i], t = directions_.tangent[i];
    if (!(P[n] > 0 && u[n] <= at_rest)) continue;
    held.push_back(n);
    if (t < 0 || u.segment(t, directions_.tangents).norm() > at_rest) continue;
    for (int k = 0; k < directions_.tangents; ++k) held.push_back(t + k);
  }
  if (!any) return;
  add_approaches(touching, -1, u);
  if (held.empty()) return;
  const Mat A = directions_.A(held, held);
  const Vec lost = -u(held), give_back = Eigen::CompleteOrthogonalDecomposition<Mat>(A).solve(lost);
  P(held) += give_back;
  dv.noalias() += directions_.jump(Eigen::all, held) * give_back;
  u.noalias() += directions_.A(Eigen::all, held) * give_back;
  u(held).setZero();
}

}  // namespace trammel::simulate
