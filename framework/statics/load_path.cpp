#include "statics/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "run/run_failed.hpp"
#include "simulate/start/equilibrium.hpp"
#include "statics/mechanism.hpp"
#include "system/equations/tangent.hpp"

namespace trammel::simulate {
namespace {

constexpr std::size_t remembered = 4;         // equilibria that a prediction goes through
constexpr double shortest_part = 1.0 / 4096;  // of a load step
constexpr int easy = 6, hard = 12;            // iterations of a part after which the next is longer, or shorter
constexpr int arcs_per_step = 50;             // before the path counts as not leading to the end
constexpr double longer_arc = 1.5;            // factor of the next arc after an easy one
constexpr double nearly_whole = 1.001;        // the rest of a load step, in parts: up to this it is one part
// Round-off of displacements and rows against the largest displacement.
constexpr double settled = 1e-12;
constexpr double satisfied = 1e-14;       // [m, rad] rows where nothing has moved yet: round-off
constexpr double difference_in_t = 1e-6;  // of the path's length in t: step of central differences of the load

}  // namespace

LoadPath::LoadPath(model::AssembledSystem& system, const Settings& settings, const State& start)
    : system_(system),
      settings_(settings),
      state_(start),
      start_(start.q),
      zero_(Vec::Zero(system.sizes().nv)),
      contacts_(system),
      turns_(system),
      theories_(system.model()),
      part_((settings.until - settings.start) / settings.load_steps) {
  state_.v = state_.a = zero_;
}

void LoadPath::advance() {
  now_ = {};
  const double step = (settings_.until - settings_.start) / settings_.load_steps;
  if (passed_.empty()) {
    begin();
  } else if (settings_.arc_length) {
    by_arc();
  } else {
    const double done = std::round((state_.t - settings_.start) / step) + 1;
    by_load(done >= settings_.load_steps ? settings_.until : settings_.start + done * step);
  }
  now_.t = state_.t;
  steps_.push_back(now_);
}

// The bodies' parameters need not be in equilibrium, for instance under weight or on a spring.
void LoadPath::begin() {
  system_.move_to(settings_.start, start_, zero_);
  contacts_.close_what_may_push();
  const Point start{settings_.start, start_, Vec::Zero(system_.sizes().nc)};
  Point first = start;
  Failure failure = solve(first, nullptr);
  if (failure != Failure::none && solve_from_rest(first)) failure = Failure::none;
  if (failure != Failure::none && turn_to_forces(first = start)) failure = solve(first, nullptr);
  if (failure != Failure::none) fail(settings_.start, failure);
  keep(std::move(first));
}

// Starts in the state of rest in which a motion with friction would end.
bool LoadPath::solve_from_rest(Point& first) {
  State rest = state_;
  rest.t = settings_.start, rest.q = start_;
  const bool found = !find_equilibrium(system_, rest);
  system_.hold_still(true);
  if (!found) return false;
  system_.move_to(rest.t, rest.q, zero_);
  contacts_.close_what_may_push();
  first = {settings_.start, rest.q, {}};
  Vec a;
  system_.accelerate({}, a, first.lambda);  // at rest there is no acceleration; a pendulum is held by its stiffness
  return solve(first, nullptr) == Failure::none;
}

void LoadPath::by_load(double t) {
  const double step = (settings_.until - settings_.start) / settings_.load_steps;
  for (double from = state_.t; from != t; from = state_.t) {
    const double rest = t - from;
    Point trial = predict(std::abs(rest) <= nearly_whole * part_ ? t : from + std::copysign(part_, rest));
    const double length = std::abs(trial.t - from);
    const int before = now_.iterations;
    const Failure failure = solve(trial, nullptr);
    if (failure != Failure::none) {
      part_ = length / 2;
      if (part_ >= shortest_part * step) continue;
      if (!turn_to_forces(passed_.back())) fail(trial.t, failure);
      part_ = step;
      continue;
    }
    if (now_.iterations - before <= easy) part_ = std::min(step, 2 * part_);
    keep(std::move(trial));
  }
}

void LoadPath::by_arc() {
  const Point& last = passed_.back();
  Vec q_by_t, lambda_by_t;
  if (!along_t(last, q_by_t, lambda_by_t)) fail(last.t, Failure::singular);
  const double step = (settings_.until - settings_.start) / settings_.load_steps;
  if (s2_ == 0 && !begin_arcs(q_by_t, step)) return by_load(settings_.until);  // nothing moves
  take_arc(arc_along(q_by_t), lambda_by_t, step * std::sqrt(2 * s2_));
  if ((state_.t - settings_.until) * step >= 0) {
    part_ = std::abs(step);
    // No polynomial in t passes through a path that has turned in t.
    passed_.erase(passed_.begin(), passed_.end() - 1);
    by_load(settings_.until);
  } else if (steps_.size() > std::size_t(arcs_per_step * settings_.load_steps)) {
    throw RunFailed(fmt::format("{} arcs along the path have not led to t = {}: the last equilibrium is at t = {:.6g}",
                                steps_.size(), settings_.until, state_.t));
  }
}

// Sets the length of the first arc, in which q and t have equal weights. False: no coordinate moves.
bool LoadPath::begin_arcs(const Vec& q_by_t, double step) {
  s2_ = q_by_t.squaredNorm() / mean_count();
  part_ = step * std::sqrt(2 * s2_);
  last_arc_ = {zero_, 1, 0};
  return s2_ != 0;
}

// The next arc along the path, in the direction of the last one.
LoadPath::Arc LoadPath::arc_along(const Vec& q_by_t) const {
  const double n = mean_count();
  double scale = 1 / std::sqrt(q_by_t.squaredNorm() / n + s2_);
  if (last_arc_.n_q.dot(q_by_t) / n + s2_ * last_arc_.n_t < 0) scale = -scale;
  return {scale * q_by_t, scale, part_};
}

void LoadPath::take_arc(Arc arc, const Vec& lambda_by_t, double longest) {
  const Point& last = passed_.back();
  for (;;) {
    arc.length = part_;
    Point trial{last.t + arc.n_t * part_, {}, last.lambda + part_ * arc.n_t * lambda_by_t};
    system_.retract(last.q, part_ * arc.n_q, trial.q);
    const int before = now_.iterations;
    const Failure failure = solve(trial, &arc);
    if (failure != Failure::none) {
      part_ /= 2;
      if (part_ < shortest_part * longest) fail(trial.t, failure);
      continue;
    }
    const int taken = now_.iterations - before;
    part_ = taken > hard ? part_ / 2 : taken <= easy ? std::min(longest, longer_arc * part_) : part_;
    last_arc_ = arc;
    return keep(std::move(trial));
  }
}

// A failed trial changes no large vector.
LoadPath::Failure LoadPath::solve(Point& trial, const Arc* arc) {
  const double load = load_, extent = extent_;
  const Failure failure = balance_with_contacts(trial, arc);
  if (failure != Failure::none) load_ = load, extent_ = extent;
  return failure;
}

// With rows of contacts that are closed where they push.
LoadPath::Failure LoadPath::balance_with_contacts(Point& trial, const Arc* arc) {
  for (;;) {
    if (trial.lambda.size() != system_.sizes().nc) {
      const auto joints = system_.model().sizes.nc;
      const Vec kept = trial.lambda.head(joints);
      trial.lambda.setZero(system_.sizes().nc);
      trial.lambda.head(joints) = kept;
    }
    if (const Failure failure = balance(trial, arc); failure != Failure::none) return failure;
    const bool closed = contacts_.close_penetrating();
    if (!closed && !contacts_.release_pulling(trial.lambda)) return Failure::none;
  }
}

LoadPath::Failure LoadPath::balance(Point& trial, const Arc* arc) {
  system_.move_to(trial.t, start_, zero_);
  load_ = std::max(load_, system_.f().norm());
  if (by_forces_ && !arc) return balance_by_forces(trial);
  Vec from = passed_.empty() ? trial.q : passed_.back().q, dq = zero_;
  double least = std::numeric_limits<double>::infinity();  // of the increments
  for (int i = 0; i <= settings_.load_iterations; ++i) {
    const bool balanced = unbalance(trial);
    if (!r_.allFinite()) return Failure::diverged;
    if (balanced) return Failure::none;
    if (i == settings_.load_iterations) break;
    const Vec before = trial.q;
    if (!correct(trial, arc, from, dq)) return Failure::singular;
    ++now_.iterations;
    from = before;
    const double change = dq.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(change) || change > 2 * least) return Failure::diverged;
    least = std::min(least, change);
    if (change <= settled * extent_) {
      unbalance(trial);
      return Failure::none;
    }
  }
  return Failure::too_many_iterations;
}

Vec LoadPath::reaction(const Point& at) {
  system_.move_to(at.t, at.q, zero_);
  Vec held = zero_;
  system_.add_reaction(1, at.lambda, held);
  return held;
}

bool LoadPath::unbalance(const Point& at) {
  const Vec held = reaction(at);
  load_ = std::max(load_, held.norm());
  r_ = held - system_.f();
  const double g = system_.g().size() > 0 ? system_.g().lpNorm<Eigen::Infinity>() : 0;
  now_.unbalanced = load_ > 0 ? r_.norm() / load_ : 0;
  return now_.unbalanced <= settings_.load_tolerance && g <= std::max(satisfied, settled * extent_);
}

// One Newton step at the system's point with r_. Stresses are extrapolated from `from` by the last increment dq, which
// is replaced by the new one.
bool LoadPath::correct(Point& at, const Arc* arc, const Vec& from, Vec& dq) {
  system_.factorise_with_stress({from, dq}, at.lambda);
  Vec dlambda, q;
  const Vec g = system_.g();
  if (!system_.correct(r_, g, dq, dlambda)) return false;
  if (arc) {
    const Point& last = passed_.back();
    Vec moved, q_by_t, lambda_by_t;
    system_.difference(at.q, last.q, moved);
    if (!along_t_with_factors(at, q_by_t, lambda_by_t)) return false;
    const double n = mean_count();
    const double missing = arc->length - arc->n_q.dot(moved + dq) / n - s2_ * arc->n_t * (at.t - last.t);
    const double dt = missing / (arc->n_q.dot(q_by_t) / n + s2_ * arc->n_t);
    dq += dt * q_by_t, dlambda += dt * lambda_by_t, at.t += dt;
  }
  system_.retract(at.q, dq, q);
  at.q = q, at.lambda += dlambda;
  extent_ = std::max(extent_, dq.lpNorm<Eigen::Infinity>());
  return std::isfinite(at.t);
}

// dq/dt and dlambda/dt along the equilibria, at `at`.
bool LoadPath::along_t(const Point& at, Vec& q_by_t, Vec& lambda_by_t) {
  system_.move_to(at.t, at.q, zero_);
  system_.factorise({0, 0, 1}, zero_, at.lambda);
  return along_t_with_factors(at, q_by_t, lambda_by_t);
}

bool LoadPath::along_t_with_factors(const Point& at, Vec& q_by_t, Vec& lambda_by_t) {
  const double dt = difference_in_t * std::abs(settings_.until - settings_.start);
  Vec r[2], g[2];
  for (const int side : {0, 1}) {
    system_.move_to(at.t + (side ? dt : -dt), at.q, zero_);
    r[side] = -system_.f();
    system_.add_reaction(1, at.lambda, r[side]);
    g[side] = system_.g();
  }
  system_.move_to(at.t, at.q, zero_);
  return system_.correct((r[1] - r[0]) / (2 * dt), (g[1] - g[0]) / (2 * dt), q_by_t, lambda_by_t);
}

// Lagrange's polynomial through the equilibria passed, in the tangent space of the last one.
LoadPath::Point LoadPath::predict(double t) const {
  const Point& last = passed_.back();
  Point to{t, last.q, last.lambda};
  Vec dq = zero_, change;
  for (std::size_t i = 0; i + 1 < passed_.size(); ++i) {
    const Point& other = passed_[i];
    double weight = 1;
    for (std::size_t j = 0; j < passed_.size(); ++j)
      if (j != i) weight *= (t - passed_[j].t) / (other.t - passed_[j].t);
    system_.difference(other.q, last.q, change);
    dq += weight * change;
    to.lambda += weight * (other.lambda - last.lambda);
  }
  system_.retract(last.q, dq, to.q);
  return to;
}

void LoadPath::keep(Point point) {
  if (const std::string impossible = theories_.look(point.t, point.q); !impossible.empty())
    throw RunFailed(fmt::format("at t = {:.9g}: {}", point.t, impossible));
  Vec moved;
  system_.difference(point.q, start_, moved);
  if (moved.size() > 0) extent_ = std::max(extent_, moved.lpNorm<Eigen::Infinity>());
  if (!passed_.empty() && passed_.back().lambda.size() != point.lambda.size()) passed_.clear();  // a kink of the path
  passed_.push_back(std::move(point));
  if (passed_.size() > remembered) passed_.pop_front();
  state_.t = passed_.back().t, state_.q = passed_.back().q, state_.lambda = passed_.back().lambda;
  ++now_.parts;
  turns_.follow(state_.t, state_.q, zero_);
}

void LoadPath::fail(double t, Failure why) {
  std::string text = fmt::format("no equilibrium was found at t = {:.6g}", t);
  if (!passed_.empty()) text += fmt::format(", after that at t = {:.6g}", passed_.back().t);
  switch (why) {
    case Failure::too_many_iterations:
      text += fmt::format(": Newton's method did not converge in {} iterations", settings_.load_iterations);
      break;
    case Failure::diverged:
      text += ": Newton's method diverged";
      break;
    default:
      text += ": the stiffness matrix is singular";
  }
  if (const auto loose = find_mechanism(system_, state_.t, passed_.empty() ? start_ : passed_.back().q))
    text += "; " + *loose + (by_forces_ ? "; if it is held, smaller load steps may lead further" : "");
  else if (!settings_.arc_length)
    text += "; if the load has a maximum there, \"static\": {\"arc_length\": true} goes past it";
  throw RunFailed(text);
}

}  // namespace trammel::simulate
