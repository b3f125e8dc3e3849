#include "modes/steady_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <trammel/decompositions.hpp>

#include "modes/nearest_steady.hpp"
#include "modes/steady_linearisation.hpp"
#include "system/on_rows/tangent_space.hpp"

namespace trammel::simulate {
namespace {

using Eigen::Vector3d;
using model::CoordinateSizes;

constexpr int most_iterations = 30;
constexpr double settled = 1e-13;      // of the coordinates' sizes
constexpr double at_round_off = 1e-9;  // of the same: steps that are below this and no longer decrease
// [1/s^2] Factor of M in the iteration matrix: coordinates without stiffness and load, such as the angle of a rotor,
// keep their values.
constexpr double damping = 1e-6;
constexpr double far = 0.5;  // of velocities: a larger change leads to another motion than the intended one
// Unbalanced forces relative to all forces: those of a state that is written with a few digits fewer than a double has.
constexpr double unbalanced = 1e-8;
// Pivots relative to the largest one that count as 0: of rotation about an axis that moves nothing, of the stiffness.
constexpr double turns_nothing = 1e-9, free_of_stiffness = 1e-9;
// Relative to the largest velocity in sizes: a frame that rotates more slowly is at rest, its rate is round-off of a.
constexpr double does_not_turn = 1e-12;
// Relative to the largest coordinate in sizes: after a longer step the iteration has diverged.
constexpr double diverges_in_world = 1e3, diverges_in_frame = 10;
constexpr double part_of_size = 0.7;  // the motion of the fastest coordinate in the time tau()

// M a - f + W^T lambda with the accelerations of the steady motion, and the size of its terms, measured by their work
// over the coordinates' sizes [N m].
struct Balance {
  Vec left_over;
  double left = 0, terms = 0;
  bool holds() const { return left <= unbalanced * terms; }
};
Balance balance(model::AssembledSystem& system, const State& s) {
  system.move_to(s.t, s.q, s.v);
  const Vec zero = Vec::Zero(s.v.size());
  Vec Ma = zero, held = zero, momentum = zero;
  system.add_mass_times(1, s.a, Ma);
  system.add_mass_times(1, s.v, momentum);
  system.add_reaction(1, s.lambda, held);
  const Vec& f = system.f();
  const CoordinateSizes sizes = system.coordinate_sizes();
  const auto work = [&](const Vec& force) { return sizes.largest_work(force); };
  const double terms =
      std::max({work(Ma), work(f), work(held), share_of_momentum * work(momentum) * sizes.largest(s.v)});
  const Vec left_over = Ma - f + held;
  return {left_over, work(left_over), terms};
}

// Omega of least size whose accelerations are nearest to the state's own.
Vector3d least_rate(model::AssembledSystem& system, const FlatTurning& flat, const State& s) {
  const model::Model& model = system.model();
  const Vec per_size = system.coordinate_sizes().of.cwiseInverse();
  Mat by_rate(s.v.size(), 3);
  for (int k = 0; k < 3; ++k) {
    const bool in_space = model.world.space == Space::spatial || k == 2;
    const TurningFrame frame(model, flat, s, in_space ? Vector3d(Vector3d::Unit(k)) : Vector3d(Vector3d::Zero()));
    by_rate.col(k) = per_size.cwiseProduct(Vec(frame.turned(s.v)));
  }
  Eigen::CompleteOrthogonalDecomposition<Mat> least;
  least.setThreshold(turns_nothing);
  least.compute(by_rate);
  if (least.rank() == 0) return Vector3d::Zero();
  const Vec a = per_size.cwiseProduct(s.a), rate_of_least = least.solve(a);
  const Vector3d rate = rate_of_least;
  return rate.norm() <= does_not_turn * per_size.cwiseProduct(s.v).lpNorm<Eigen::Infinity>()
             ? Vector3d(Vector3d::Zero())
             : rate;
}

bool lasts(model::AssembledSystem& system, const FlatTurning& flat, const State& s, double tau, const Vector3d& rate) {
  if (!balance(system, steady_state(system, flat, s, rate)).holds()) return false;
  const State later = steady_state(system, flat, TurningFrame(system.model(), flat, s, rate).after(tau), rate);
  return later.lambda.allFinite() && balance(system, later).holds();
}

SteadyMotion steady_as_it_is(model::AssembledSystem& system, const FlatTurning& flat, State s) {
  system.move_to(s.t, s.q, s.v);
  system.accelerate({}, s.a, s.lambda);
  const double speed = system.coordinate_sizes().largest(s.v);
  SteadyMotion motion{std::move(s), {}, speed};
  std::vector<Vector3d> rates = body_rates(system.model(), motion.state);
  rates.insert(rates.begin(), least_rate(system, flat, motion.state));
  for (const Vector3d& rate : rates)
    if (lasts(system, flat, motion.state, motion.tau(), rate)) motion.rates.push_back(rate);
  return motion;
}

// Newton's method as seen from the world: v unchanged, a = 0.
std::optional<std::string> settle_in_the_world(model::AssembledSystem& system, State& s) {
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
    const CoordinateSizes sizes = system.coordinate_sizes();
    const double change = sizes.largest(dq);
    if (!std::isfinite(change) || change > diverges_in_world * sizes.place) break;
    system.retract(s.q, dq, q);
    s.q = q, s.lambda += dlambda;
    system.move_to(s.t, s.q, s.v);
    if (system.sizes().nc > 0) {
      system.factorise({1, 0, 0}, zero, Vec::Zero(system.sizes().nc), Factors::projection);
      if (!system.correct(zero, Vec(system.g_dot()), dv, unused, Factors::projection)) break;
      s.v += dv;
      system.move_to(s.t, s.q, s.v);
    }
    // At round-off steps no longer decrease.
    const double size = sizes.place;
    if (change <= settled * size || (change <= at_round_off * size && change >= before)) return {};
    before = change;
  }
  return fmt::format("Newton's method did not settle in {} iterations", most_iterations);
}

// Newton's method as seen from a rotating frame, with K_r of the linearised equations.
class InFrame {
 public:
  InFrame(model::AssembledSystem& system, const FlatTurning& flat, const Vector3d& rate)
      : system_(system), flat_(flat), rate_(rate) {}

  std::optional<std::string> settle(State& s) {
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_iterations; ++i) {
      s = steady_state(system_, flat_, s, rate_);
      if (!s.lambda.allFinite()) break;
      const Vec left_over = balance(system_, s).left_over;
      const TangentSpace space = tangent_space(system_);
      const TurningFrame frame(system_.model(), flat_, s, rate_);
      const Mat K = coefficients_in(system_, frame, s, space.Z, space.left).K;
      Eigen::CompleteOrthogonalDecomposition<Mat> least;  // coordinates without stiffness keep their values
      least.setThreshold(free_of_stiffness);
      least.compute(K);
      const Vec along_rows = -space.left.transpose() * left_over, dq = space.Z * least.solve(along_rows);
      const double change = space.sizes.largest(dq), size = space.sizes.place;
      if (!std::isfinite(change) || change > diverges_in_frame * size) break;
      move(s, dq);
      const auto along = [&](const State& at, const Vec& by) -> Vec {
        return TurningFrame(system_.model(), flat_, at, rate_).turned(by);
      };
      if (!onto_rows(system_, s, along)) break;
      if (change <= settled * size || (change <= at_round_off * size && change >= before)) return {};
      before = change;
    }
    return fmt::format("Newton's method did not settle in {} iterations", most_iterations);
  }

 private:
  void move(State& s, const Vec& dq) {
    s.v += TurningFrame(system_.model(), flat_, s, rate_).turned(dq);
    Vec q;
    system_.retract(s.q, dq, q);
    s.q = q;
  }

  model::AssembledSystem& system_;
  const FlatTurning& flat_;
  Vector3d rate_;
};

}  // namespace

double SteadyMotion::tau() const {
  return part_of_size / std::max(1e-300, speed);
}

State steady_state(model::AssembledSystem& system, const FlatTurning& flat, State at, const Vector3d& rate) {
  system.move_to(at.t, at.q, at.v);
  system.accelerate({}, at.a, at.lambda);
  at.a = TurningFrame(system.model(), flat, at, rate).turned(at.v);
  return at;
}

SteadyMotion steady_as_it_is(model::AssembledSystem& system, const State& state) {
  return steady_as_it_is(system, flat_turning(system, state.t, state.q), state);
}

std::variant<SteadyMotion, std::string> find_steady_motion(model::AssembledSystem& system, const State& state) {
  const FlatTurning flat = flat_turning(system, state.t, state.q);
  if (!state.v.isZero(0))
    if (SteadyMotion motion = steady_as_it_is(system, flat, state); !motion.rates.empty()) return motion;

  State s = state;
  std::optional<std::string> why = settle_in_the_world(system, s);
  if (!why) {
    s.a = Vec::Zero(s.v.size());
    if (s.v.isZero(0)) return SteadyMotion{s, {Vector3d::Zero()}, 0};
    if (SteadyMotion motion = steady_as_it_is(system, flat, s); !motion.rates.empty()) return motion;
    why = "the motion that Newton's method found does not last";
  }
  if (state.v.isZero(0)) return *why;
  std::vector<Vector3d> rates = body_rates(system.model(), state);
  system.move_to(state.t, state.q, state.v);
  s = state;
  system.accelerate({}, s.a, s.lambda);
  rates.insert(rates.begin(), least_rate(system, flat, s));
  for (const Vector3d& rate : rates) {
    if (rate.isZero(0)) continue;
    s = state;
    if (InFrame(system, flat, rate).settle(s)) continue;
    const CoordinateSizes sizes = system.coordinate_sizes();
    if (sizes.largest(s.v - state.v) > far * sizes.largest(state.v)) continue;
    if (SteadyMotion motion = steady_as_it_is(system, flat, s); !motion.rates.empty()) return motion;
  }
  for (const Vector3d& rate : rates)
    if (const std::optional<State> found = nearest_steady(system, flat, state, rate))
      if (SteadyMotion motion = steady_as_it_is(system, flat, *found); !motion.rates.empty()) return motion;
  return *why;
}

}  // namespace trammel::simulate
