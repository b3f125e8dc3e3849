#include "statics/mechanism.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "system/point/pseudo_random.hpp"

namespace trammel::simulate {

namespace {

constexpr double difference_in_q = 1e-6;  // [m, rad] the largest change of a coordinate in a difference of forces
// The shift: this part of omega^2 of a pseudo-random motion, which is near that of the stiffest motion, so it is the
// round-off of K with a margin; at least `least_shift` [1/s^2], for systems where nothing is stiff.
constexpr double share_of_stiffest = 1e-12, least_shift = 1e-12;
constexpr double resists = 10;  // omega^2 of the softest motion, in shifts: a motion above it has a stiffness
// Each iteration reduces the other motions by the ratio of the softest omega^2 to theirs, shift included.
constexpr int inverse_iterations = 4;

Vec mass_times(model::AssembledSystem& system, const Vec& x) {
  Vec r = Vec::Zero(x.size());
  system.add_mass_times(1, x, r);
  return r;
}

double mass_norm(model::AssembledSystem& system, const Vec& x) {
  return std::sqrt(std::max(0.0, x.dot(mass_times(system, x))));
}

// A pseudo-random motion of length 1 in the mass's norm, with the system at rest at q.
Vec random_motion(model::AssembledSystem& system, double t, const Vec& q) {
  const Vec zero = Vec::Zero(system.sizes().nv);
  system.move_to(t, q, zero);
  const Vec x = model::pseudo_random(zero.size(), 1, 1);
  return x / mass_norm(system, x);
}

// The motion of least stiffness, of length 1 in the mass's norm, by inverse iteration; empty if it resists or if the
// matrix is singular.
std::optional<Vec> motion_without_resistance(model::AssembledSystem& system, double t, const Vec& q) {
  const double stiffest = stiffness_of_random_motion(system, t, q);
  if (!std::isfinite(stiffest)) return {};
  const double shift = std::max(share_of_stiffest * stiffest, least_shift);
  const Vec zero = Vec::Zero(system.sizes().nv), no_rows = Vec::Zero(system.sizes().nc);
  Vec x = random_motion(system, t, q), y, mu;
  double growth = 0;
  for (int i = 0; i < inverse_iterations; ++i) {
    const Vec Mx = -mass_times(system, x);
    system.factorise({shift, 0, 1}, zero, no_rows);
    if (!system.correct(Mx, no_rows, y, mu)) return {};
    growth = mass_norm(system, y);
    if (!(growth > 0) || !std::isfinite(growth)) return {};
    x = y / growth;
  }
  if (std::abs(1 / growth - shift) > resists * shift) return {};
  return x;
}

// The body with the largest share of the motion in the mass's norm; null: none moves.
const model::BodyEntry* body_that_moves_most(model::AssembledSystem& system, const Vec& x) {
  const model::BodyEntry* found = nullptr;
  double most = 0;
  for (const model::BodyEntry& body : system.model().bodies) {
    if (body.nv == 0) continue;
    Vec alone = Vec::Zero(x.size());
    alone.segment(body.v0, body.nv) = x.segment(body.v0, body.nv);
    if (const double share = mass_norm(system, alone); share > most) most = share, found = &body;
  }
  return found;
}

}  // namespace

double stiffness_of_random_motion(model::AssembledSystem& system, double t, const Vec& q) {
  const Vec x = random_motion(system, t, q), zero = Vec::Zero(x.size());
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
  const std::optional<Vec> motion = motion_without_resistance(system, t, q);
  const model::BodyEntry* loose = motion ? body_that_moves_most(system, *motion) : nullptr;
  if (!loose) return {};
  return fmt::format(
      "bodies.{} is a mechanism: it can move without resistance, or with less than the round-off of its stiffest "
      "motion; hold it by a joint, an edge or a spring",
      loose->name);
}

}  // namespace trammel::simulate
