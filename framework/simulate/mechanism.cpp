#include "simulate/mechanism.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulate/unrelated.hpp"

namespace trammel::simulate {

std::optional<std::string> find_mechanism(model::AssembledSystem& system, double t, const Vec& q) {
  const Vec zero = Vec::Zero(system.sizes().nv);
  const Vec lambda = Vec::Zero(system.sizes().nc);
  system.carry_no_stress();
  system.move_to(t, q, zero);
  Vec x = unrelated(zero.size(), 1, 1), ahead, behind, mu, Mx;
  const auto mass_times = [&](const Vec& y) {
    Vec r = zero;
    system.add_mass_times(1, y, r);
    return r;
  };
  const auto norm = [&](const Vec& y) { return std::sqrt(std::max(0.0, y.dot(mass_times(y)))); };
  x /= norm(x);
  const double step = 1e-6 / std::max(1e-300, x.lpNorm<Eigen::Infinity>());
  for (const double side : {1.0, -1.0}) {
    Vec moved;
    system.retract(q, side * step * x, moved);
    system.move_to(t, moved, zero);
    (side > 0 ? ahead : behind) = system.f();
  }
  const double stiff = std::abs(x.dot(behind - ahead)) / (2 * step);  // omega^2 of the random motion
  if (!std::isfinite(stiff)) return {};
  const double shift = std::max(1e-12 * stiff, 1e-12);
  system.move_to(t, q, zero);
  const Vec no_rows = Vec::Zero(system.sizes().nc);
  double growth = 0;
  for (int i = 0; i < 4; ++i) {
    Mx = -mass_times(x);
    system.factorise({shift, 0, 1}, zero, lambda);
    Vec y;
    if (!system.correct(Mx, no_rows, y, mu)) return {};
    growth = norm(y);
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
    if (const double share = norm(alone); share > most) most = share, loose = &body;
  }
  if (!loose) return {};
  return fmt::format(
      "bodies.{} is a mechanism: it can move without resistance, or with less than the round-off of what it is "
      "stiffest in; "
      "hold it by a joint, an edge or a spring",
      loose->name);
}

}  // namespace trammel::simulate
