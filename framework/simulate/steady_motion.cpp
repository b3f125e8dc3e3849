#include "simulate/steady_motion.hpp"

#include <cmath>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

constexpr int most_iterations = 30;
constexpr double settled = 1e-13;  // [m, rad] of coordinates of order 1
// [1/s^2] of M in the iteration matrix: what nothing holds and nothing pushes, as the angle of a rotor, keeps its place.
constexpr double damping = 1e-6;

}  // namespace

std::optional<std::string> find_steady_motion(model::AssembledSystem& system, State& s) {
  const Vec zero = Vec::Zero(system.sizes().nv);
  Vec r, q, dq, dv, dlambda, unused;
  system.move_to(s.t, s.q, s.v);
  system.accelerate({}, s.a, s.lambda);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    r = -system.f();
    system.add_reaction(1, s.lambda, r);
    system.factorise({damping, 0, 1}, zero, s.lambda);
    if (!system.correct(r, system.g(), dq, dlambda)) return "its stiffness there is singular";
    const double change = dq.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(change) || change > 1e3 * std::max(1.0, s.q.lpNorm<Eigen::Infinity>())) break;
    system.retract(s.q, dq, q);
    s.q = q, s.lambda += dlambda;
    system.move_to(s.t, s.q, s.v);
    if (system.sizes().nc > 0) {
      system.factorise({1, 0, 0}, zero, Vec::Zero(system.sizes().nc), Factors::projection);
      if (!system.correct(zero, Vec(system.g_dot()), dv, unused, Factors::projection)) break;
      s.v += dv;
      system.move_to(s.t, s.q, s.v);
    }
    const double size = std::max(1.0, s.q.lpNorm<Eigen::Infinity>());
    // At the end of the digits steps no longer shrink.
    if (change <= settled * size || (change <= 1e-9 * size && change >= before)) {
      s.a = zero;
      return {};
    }
    before = change;
  }
  return fmt::format("Newton's method did not settle in {} iterations", most_iterations);
}

}  // namespace trammel::simulate
