// Why energy never grows without friction, for any e_i <= 1: the compression takes N_C . A N_C/2, since N_C . u_C = 0.
// With N_E = e N_C + dN, dN . u+ = 0 and u+ = u_C + A N_E the expansion gives
//
//     N_E . (u_C + u+)/2 = N_E . u+ - N_E . A N_E/2     and     N_E . u+ = e N_C . u+ <= N_C . u+ = N_C . A N_E,
//
// so at most N_C . A N_E - N_E . A N_E/2 <= N_C . A N_C/2. With friction no such bound is known; a gain is a warning
// (impact_warnings.hpp).
#include "simulate/impact/poisson_impact.hpp"

namespace trammel::simulate {
namespace {

using complementarity::ContactSolution;
using complementarity::LcpOutcome;

}  // namespace

Participant PoissonImpact::participant(const TouchingContact& c, std::size_t i, const Vec& rates) const {
  Participant p;
  p.contact = c.contact;
  p.a_n = rates[directions_.normal[i]];
  if (directions_.tangent[i] < 0) return p;
  p.tangent = Participant::Tangent::resting;
  p.mu_0 = directions_.friction[i].mu_0, p.mu = directions_.friction[i].mu;
  p.a_t.head(directions_.tangents) = rates.segment(directions_.tangent[i], directions_.tangents);
  return p;
}

ContactSolution PoissonImpact::compress(model::AssembledSystem& system, double at_rest,
                                        const std::vector<TouchingContact>& touching, Vec& rates, Vec& P) {
  problem_.who.clear();
  for (std::size_t i = 0; i < touching.size(); ++i)
    problem_.who.push_back(participant(touching[i], i, directions_.rates));
  problem_.prepare(system);
  const ContactSolution solution = problem_.solve(at_rest);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const Participant& p = problem_.who[i];
    P[directions_.normal[i]] = p.N, rates[directions_.normal[i]] = p.a_n;
    if (directions_.tangent[i] < 0) continue;
    P.segment(directions_.tangent[i], directions_.tangents) = p.T.head(directions_.tangents);
    rates.segment(directions_.tangent[i], directions_.tangents) = p.a_t.head(directions_.tangents);
  }
  return solution;
}

ContactSolution PoissonImpact::expand(model::AssembledSystem& system, double at_rest,
                                      const std::vector<TouchingContact>& touching, const Vec& compression, Vec& rates,
                                      Vec& P) {
  for (std::size_t i = 0; i < touching.size(); ++i)
    P[directions_.normal[i]] = touching[i].restitution * compression[directions_.normal[i]];
  rates += directions_.A * P;
  problem_.who.clear();
  for (std::size_t i = 0; i < touching.size(); ++i) problem_.who.push_back(participant(touching[i], i, rates));
  std::vector<std::size_t> given;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    if (directions_.tangent[i] < 0 || P[directions_.normal[i]] == 0) continue;
    Participant p = problem_.who[i];
    p.unilateral = false;
    p.given = P[directions_.normal[i]];
    problem_.who.push_back(p);
    given.push_back(i);
  }
  problem_.prepare(system);
  const ContactSolution solution = problem_.solve(at_rest);
  const auto add_friction = [&](std::size_t i, const Participant& p) {
    if (directions_.tangent[i] < 0) return;
    P.segment(directions_.tangent[i], directions_.tangents) += p.T.head(directions_.tangents);
    rates.segment(directions_.tangent[i], directions_.tangents) = p.a_t.head(directions_.tangents);
  };
  for (std::size_t i = 0; i < touching.size(); ++i) {
    P[directions_.normal[i]] += problem_.who[i].N;
    rates[directions_.normal[i]] = problem_.who[i].a_n;
    add_friction(i, problem_.who[i]);
  }
  for (std::size_t k = 0; k < given.size(); ++k) add_friction(given[k], problem_.who[touching.size() + k]);
  return solution;
}

void PoissonImpact::take(std::vector<TouchingContact>& touching, const Vec& P_C, const Vec& u_C, const Vec& P_E,
                         const Vec& u) const {
  const auto loss = [](const Vec& P, const Vec& from, const Vec& to, int first, int count) {
    return -0.5 * P.segment(first, count).dot(from.segment(first, count) + to.segment(first, count));
  };
  for (std::size_t i = 0; i < touching.size(); ++i) {
    TouchingContact& c = touching[i];
    const int n = directions_.normal[i], t = directions_.tangent[i];
    c.impulse = P_C[n] + P_E[n];
    c.after = (c.was_closed ? c.before : 0) + u[n];
    c.friction.setZero();
    c.slip_after.setZero();
    double lost = loss(P_C, directions_.rates, u_C, n, 1) + loss(P_E, u_C, u, n, 1);
    if (t >= 0) {
      c.friction.head(directions_.tangents) = (P_C + P_E).segment(t, directions_.tangents);
      c.slip_after.head(directions_.tangents) = u.segment(t, directions_.tangents);
      lost += loss(P_C, directions_.rates, u_C, t, directions_.tangents) + loss(P_E, u_C, u, t, directions_.tangents);
    }
    c.course = lost - c.loss_at_mean_rates();
  }
}

ContactSolution PoissonImpact::solve(model::AssembledSystem& system, double at_rest,
                                     std::vector<TouchingContact>& touching, Vec& dv) {
  directions_.prepare(system, touching);
  const auto m = directions_.rates.size();
  Vec P_C = Vec::Zero(m), P_E = Vec::Zero(m), u_C = directions_.rates;
  const ContactSolution compressed = compress(system, at_rest, touching, u_C, P_C);
  if (compressed.outcome != LcpOutcome::solved) return compressed;
  Vec u = u_C;
  const ContactSolution expanded = expand(system, at_rest, touching, P_C, u, P_E);
  if (expanded.outcome != LcpOutcome::solved) return expanded;
  dv.noalias() = directions_.jump * (P_C + P_E);
  take(touching, P_C, u_C, P_E, u);
  return expanded;
}

}  // namespace trammel::simulate
