// Equilibria by what forces tell where the stiffness matrix has lost its softest motions; see load_path.hpp.
#include <algorithm>

#include "numerics/anderson.hpp"
#include "simulate/load_path.hpp"
#include "simulate/mechanism.hpp"

namespace trammel::simulate {

namespace {

// Of the largest omega^2: above the round-off of K and what passes for singular, as little above as may be.
constexpr double shift = 1e-14;
// Of the largest displacement. The shift takes some digits from 1e-16, and Anderson's steps converge faster than linearly.
constexpr double settled = 1e-10;
// As many as there are motions softer than the shift, and some.
constexpr int most_steps = 60;

}  // namespace

// From where `trial` is; true: from now on it is the way to all equilibria.
bool LoadPath::solve_by_forces(Point& trial) {
  if (by_forces_ || !find_mechanism(system_, trial.t, trial.q)) return false;
  by_forces_ = true;
  by_forces_ = solve(trial, nullptr) == Failure::none;
  return by_forces_;
}

LoadPath::Failure LoadPath::balance_by_forces(Point& trial) {
  const Point from = trial;
  const Eigen::Index nv = zero_.size(), nc = system_.sizes().nc;
  system_.carry_no_stress();
  const double shift_of_M = shift * stiffness_of_unrelated_motion(system_, trial.t, trial.q);
  numerics::Anderson accelerated;
  Vec moved = Vec::Zero(nv + nc), step(nv + nc), dq, dlambda;
  for (int i = 0; i < most_steps; ++i) {
    const bool balanced = unbalance(trial);
    if (!r_.allFinite()) return Failure::diverged;
    if (balanced) return Failure::none;
    if (i == 0) system_.factorise({shift_of_M, 0, 1}, zero_, trial.lambda);
    if (!system_.correct(r_, system_.g(), dq, dlambda)) return Failure::singular;
    ++now_.iterations;
    step << dq, dlambda;
    const Vec change = accelerated.next(step);
    moved += change;
    if (!moved.allFinite()) return Failure::diverged;
    extent_ = std::max(extent_, moved.head(nv).lpNorm<Eigen::Infinity>());
    system_.retract(from.q, moved.head(nv), trial.q);
    trial.lambda = from.lambda + moved.tail(nc);
    const double most = std::max(dq.lpNorm<Eigen::Infinity>(), change.head(nv).lpNorm<Eigen::Infinity>());
    if (most <= settled * extent_) {
      unbalance(trial);
      return Failure::none;
    }
  }
  return Failure::too_many_iterations;
}

}  // namespace trammel::simulate
