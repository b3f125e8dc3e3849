#include "simulate/impact/energetic_impact.hpp"

#include "simulate/impact/spring_impact.hpp"

namespace trammel::simulate {

complementarity::ContactSolution EnergeticImpact::solve(model::AssembledSystem& system,
                                                        std::vector<TouchingContact>& touching, Vec& dv) {
  directions_.prepare(system, touching);
  std::vector<SpringContact> springs;
  for (std::size_t i = 0; i < touching.size(); ++i)
    springs.push_back({directions_.normal[i], directions_.tangent[i], touching[i].restitution,
                       directions_.friction[i].mu_0, directions_.friction[i].mu});
  SpringImpact impact(springs, directions_.A, directions_.rates, directions_.tangents);
  const complementarity::ContactSolution solution = impact.run();
  cut_short_ = impact.cut_short();
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  const Vec &P = impact.admissible_impulses(), u = impact.rates();
  dv.noalias() = directions_.jump * impact.impulses();
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

}  // namespace trammel::simulate
