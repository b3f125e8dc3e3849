#include "system/on_rows/onto_rows.hpp"

#include <cmath>
#include <limits>

namespace trammel::model {

namespace {

constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

double largest(const Vec& x) {
  return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0;
}

bool at_round_off(AssembledSystem& system, const Vec& g, const Vec& q) {
  if (largest(g) > rounding * largest(q)) return false;
  const CoordinateSizes sizes = system.coordinate_sizes();
  const Vec of_coordinates = system.sparse_rows().cwiseAbs() * (sizes.place * sizes.of);
  return (g.cwiseAbs() - rounding * of_coordinates.cwiseMin(largest(q))).maxCoeff() <= 0;
}

}  // namespace

bool positions_onto_rows(AssembledSystem& system, State& s, const OntoRows& how) {
  const Vec no_force = Vec::Zero(system.sizes().nv), no_multiplier = Vec::Zero(system.sizes().nc);
  Vec g, dq, mu, q;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0;; ++i) {
    system.move_to(s.t, s.q, s.v);
    g = system.g();
    if (g.size() == 0) return true;
    const double now = largest(g);
    if (!std::isfinite(now)) return false;
    const bool met = at_round_off(system, g, s.q) || (now <= how.allowed && now > 0.5 * before);
    if (met || i == how.most) return met || now <= how.allowed;
    before = now;
    system.factorise(how.metric, no_force, no_multiplier, Factors::projection);
    if (!system.correct(no_force, g, dq, mu, Factors::projection)) return false;
    if (how.along) s.v += how.along(s, dq);
    system.retract(s.q, dq, q);
    s.q = q;
  }
}

bool velocities_onto_rows(System& system, State& s, Blend metric) {
  constexpr int passes = 2;
  if (system.sizes().nc == 0) return true;
  const Vec no_force = Vec::Zero(system.sizes().nv), no_multiplier = Vec::Zero(system.sizes().nc);
  Vec dv, mu;
  for (int pass = 0; pass < passes; ++pass) {
    system.move_to(s.t, s.q, s.v);
    const Vec g_dot = system.g_dot();
    if (pass == 0) system.factorise(metric, no_force, no_multiplier, Factors::projection);
    if (!system.correct(no_force, g_dot, dv, mu, Factors::projection)) return false;
    s.v += dv;
  }
  system.move_to(s.t, s.q, s.v);
  return true;
}

}  // namespace trammel::model
