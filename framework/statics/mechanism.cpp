#include "statics/mechanism.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "system/point/pseudo_random.hpp"

namespace trammel::simulate {

namespace {

constexpr double difference_in_q = 1e-6;  // [m, rad] the largest change of a coordinate in a difference of forces
// omega^2 of a motion without resistance: of that of an unrelated motion, which is near the stiffest one's, the
// round-off of K with a margin; and [1/s^2], where nothing is stiff.
constexpr double without_resistance = 1e-12, least_stiffness = 1e-12;
constexpr int inverse_iterations = 4;  // each leaves of other motions the ratio of the softest omega^2 to theirs

Vec mass_times(model::AssembledSystem& system, const Vec& x) {
  Vec r = Vec::Zero(x.size());
  system.add_mass_times(1, x, r);
  return r;
}

double mass_norm(model::AssembledSystem& system, const Vec& x) {
  return std::sqrt(std::max(0.0, x.dot(mass_times(system, x))));
}

// A pseudo-random motion of length 1 in the mass's norm, with the system at rest at q.
Vec unrelated_motion(model::AssembledSystem& system, double t, const Vec& q) {
  const Vec zero = Vec::Zero(system.sizes().nv);
  system.move_to(t, q, zero);
  const Vec x = model::pseudo_random(zero.size(), 1, 1);
  return x / mass_norm(system, x);
}

}  // namespace

double stiffness_of_unrelated_motion(model::AssembledSystem& system, double t, const Vec& q) {
  const Vec x = unrelated_motion(system, t, q), zero = Vec::Zero(x.size());
  const double step = difference_in_q / std::max(1e-300, x.lpNorm<Eigen::Infinity>());
  Vec ahead, behind, moved;
  for (const double side : {1.0, -1.0}) {
    system.retract(q, side * step * x, moved);
    system.move_to(t, moved, zero);
    (side > 0 ? ahead : behind) = system.f();
  }
  return std::abs(x.dot(behind - ahead)) / (2 * step);
}

std::optional<std::string> find_mechanism(model::AssembledSystem& system, double t, const Vec& q) {
  const Vec zero = Vec::Zero(system.sizes().nv);
  const Vec lambda = Vec::Zero(system.sizes().nc);
  const double stiff = stiffness_of_unrelated_motion(system, t, q);
  if (!std::isfinite(stiff)) return {};
  const double shift = std::max(without_resistance * stiff, least_stiffness);
  Vec x = unrelated_motion(system, t, q), mu;
  const Vec no_rows = Vec::Zero(system.sizes().nc);
  double growth = 0;
  for (int i = 0; i < inverse_iterations; ++i) {
    const Vec Mx = -mass_times(system, x);
    system.factorise({shift, 0, 1}, zero, lambda);
    Vec y;
    if (!system.correct(Mx, no_rows, y, mu)) return {};
    growth = mass_norm(system, y);
    if (!(growth > 0) || !std::isfinite(growth)) return {};
    x = y / growth;
  }
  if (std::abs(1 / growth - shift) > 10 * shift) return {};
  const model::BodyEntry* loose = nullptr;
  double most = 0;
  for (const model::BodyEntry& body : system.model().bodies) {
    if (body.nv == 0) continue;
    Vec alone = zero;
    alone.segment(body.v0, body.nv) = x.segment(body.v0, body.nv);
    if (const double share = mass_norm(system, alone); share > most) most = share, loose = &body;
  }
  if (!loose) return {};
  return fmt::format(
      "bodies.{} is a mechanism: it can move without resistance, or with less than the round-off of its stiffest "
      "motion; hold it by a joint, an edge or a spring",
      loose->name);
}

}  // namespace trammel::simulate
