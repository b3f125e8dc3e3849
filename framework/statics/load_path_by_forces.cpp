// Equilibria from forces alone where the stiffness matrix has lost its softest motions; see load_path.hpp.
#include <algorithm>
#include <limits>

#include "statics/anderson.hpp"
#include "statics/load_path.hpp"
#include "statics/mechanism.hpp"

namespace trammel::simulate {

namespace {

// Relative to the largest omega^2: just above the round-off of K and what counts as singular.
constexpr double shift = 1e-14;
// Relative to the largest displacement: increments that are small enough, and those that may be round-off of forces.
constexpr double small = 1e-10, nearly_small = 1e-6;
constexpr double inexact = 1e-5;  // error of an increment, relative to it; Newton's next step corrects the rest
// Step of central differences along an increment: `part_of_increment` of it, but at least a motion by `least_motion` of
// the largest displacement, whose change of force exceeds the forces' round-off.
constexpr double part_of_increment = 1e-3, least_motion = 1e-6;
// Of Anderson's method: it needs one for each motion that is softer than the shift, and a few more.
constexpr int most_steps = 60;

constexpr double far_away = 1e6;  // [m, rad]: a motion without any resistance under a load

double largest(const Vec& x) {
  return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0;
}

}  // namespace

// From now on all equilibria are computed in this way, if it can succeed.
bool LoadPath::turn_to_forces(const Point& from) {
  if (by_forces_ || !find_mechanism(system_, from.t, from.q)) return false;
  return by_forces_ = true;
}

LoadPath::Failure LoadPath::balance_by_forces(Point& trial) {
  const double shift_of_M = shift * stiffness_of_random_motion(system_, trial.t, trial.q);
  double least = std::numeric_limits<double>::infinity();  // of the increments
  Vec dq, dlambda, q;
  for (int i = 0; i <= settings_.load_iterations; ++i) {
    const bool balanced = unbalance(trial);
    if (!r_.allFinite()) return Failure::diverged;
    if (balanced) return Failure::none;
    if (i == settings_.load_iterations) break;
    system_.factorise({shift_of_M, 0, 1}, zero_, trial.lambda);
    if (const Failure failure = correct_by_forces(trial, dq, dlambda); failure != Failure::none) return failure;
    const double change = largest(dq);
    if (!(change < far_away)) return Failure::diverged;
    extent_ = std::max(extent_, change);
    const bool round_off = change >= least && change <= nearly_small * extent_;  // decreases no further
    if (change > 2 * least && !round_off) return Failure::diverged;
    least = std::min(least, change);
    system_.retract(trial.q, dq, q);
    trial.q = q, trial.lambda += dlambda;
    now_.by_forces = change;
    if (change > small * extent_ && !round_off) continue;
    unbalance(trial);
    return Failure::none;
  }
  return Failure::too_many_iterations;
}

// Newton's increment, r + (dr/dx) x = 0 and g + (dg/dx) x = 0 for x = (dq, dlambda), with differences of r and g along
// x.
LoadPath::Failure LoadPath::correct_by_forces(const Point& at, Vec& dq, Vec& dlambda) {
  const Eigen::Index nv = zero_.size(), nc = at.lambda.size();
  const Vec r = r_, g = system_.g();
  Vec r_left = r, g_left = g, x = Vec::Zero(nv + nc), step(nv + nc);
  numerics::Anderson accelerated;
  for (int i = 0; i < most_steps; ++i) {
    if (!system_.correct(r_left, g_left, dq, dlambda)) return Failure::singular;
    ++now_.iterations;
    step << dq, dlambda;
    const Vec change = accelerated.next(step);
    x += change;
    if (!x.allFinite()) return Failure::diverged;
    const double size = largest(x.head(nv)), left = std::max(largest(dq), largest(change.head(nv)));
    if (left <= std::max(inexact * size, small * extent_ / 10)) {
      dq = x.head(nv), dlambda = x.tail(nc);
      return Failure::none;
    }
    const double part = std::max(part_of_increment, least_motion * extent_ / size);
    Vec r_at[2], g_at[2];
    for (const int side : {0, 1}) {
      const double to = side ? part : -part;
      Point there{at.t, {}, at.lambda + to * x.tail(nc)};
      system_.retract(at.q, to * x.head(nv), there.q);
      r_at[side] = reaction(there);
      r_at[side] -= system_.f();
      g_at[side] = system_.g();
    }
    r_left = r + (r_at[1] - r_at[0]) / (2 * part);
    g_left = g + (g_at[1] - g_at[0]) / (2 * part);
  }
  return Failure::too_many_iterations;
}

}  // namespace trammel::simulate
