#include "simulate/start/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "simulate/contact/resting_contacts.hpp"
#include "simulate/watch/turn_counts.hpp"
#include "system/on_rows/onto_rows.hpp"

namespace trammel::simulate {
namespace {

constexpr int most_steps = 300;
constexpr double tau_first = 1e-3;   // [s]
constexpr double tau_least = 1e-12;  // [s] no shorter step makes progress
constexpr double tau_last = 100;     // relative to 1 s, or to the time of a fall through the scene if that is longer
constexpr double settled = 1e-14;    // relative to the coordinates' sizes and places: round-off
constexpr double far_off = 1e6;      // relative to their sizes
constexpr double balanced = 1e-12;   // of the largest unbalanced acceleration so far: round-off of forces
constexpr double moment = 1e-4;      // [s] before and after, in the central difference of loads that depend on time

class StaticEquilibrium {
 public:
  StaticEquilibrium(model::AssembledSystem& system, State& state)
      : system_(system),
        state_(state),
        nv_(system.sizes().nv),
        zero_v_(Vec::Zero(nv_)),
        contacts_(system),
        turns_(system) {
    turns_.follow(state_.t, state_.q, zero_v_);
    system_.move_to(state_.t, state_.q, zero_v_);
    const double g = system_.model().world.gravity.norm();
    if (g > 0) slow_ = std::max(slow_, std::sqrt(system_.coordinate_sizes().length / g));
    contacts_.close_what_may_push();
  }

  bool settle() {
    double tau = tau_first;
    double unbalanced = look(state_.q);
    for (int i = 0; i < most_steps; ++i) {
      Vec q_next;
      const bool found = step(tau, q_next);
      const model::CoordinateSizes sizes = system_.coordinate_sizes();
      const double change = found ? sizes.largest(dq_) : 0;
      if (!std::isfinite(change) || change > far_off * sizes.place) return false;
      if (found && change <= settled * sizes.place) {
        if (tau < slow_) {  // perhaps small only because of the damping
          tau *= 10;
          continue;
        }
        look(state_.q);
        if (!contacts_.release_pulling(lambda_)) return true;
        unbalanced = look(state_.q);
        continue;
      }
      // Component of the unbalanced acceleration along itself: predicted by the linearised equations, and after the
      // step.
      const double noise = balanced * scale_, with_forces = found ? a_.dot(mass_times(dq_)) : -1;
      const double promised = unbalanced > noise ? with_forces / (unbalanced * tau * tau) : 0;
      const double next = found ? look(q_next) : 0;
      const bool against = with_forces < 0 && unbalanced > noise;
      if (!found || against || !(std::abs(next - promised) <= 1.5 * unbalanced + noise)) {
        tau /= 4;
        look(state_.q);
        if (tau < tau_least) return false;
        continue;
      }
      const double shrunk = next > 0 ? unbalanced / next : 10;
      tau = std::min(tau_last * slow_, tau * 2 * std::clamp(shrunk, 0.7, 5.0));
      state_.q = q_next;
      turns_.follow(state_.t, state_.q, zero_v_);
      unbalanced = contacts_.close_penetrating() ? look(state_.q) : next;
    }
    return false;
  }

  // The body that the forces accelerate most, and by how much.
  std::string culprit() {
    look(state_.q);
    const model::BodyEntry* worst = nullptr;
    double largest = 0;
    for (const model::BodyEntry& body : system_.model().bodies) {
      if (body.nv == 0) continue;
      const double a = a_.segment(body.v0, body.nv).lpNorm<Eigen::Infinity>();
      if (!worst || !(a <= largest)) worst = &body, largest = a;
    }
    return worst
               ? fmt::format("bodies.{} is left with an acceleration of {:.3g} (m/s^2, rad/s^2)", worst->name, largest)
               : std::string("nothing can move");
  }

  // Finds q' of the equilibrium (see the header). `state.q` is settled. Returns the direction without a rate, if any.
  std::optional<std::string> follow() {
    look(state_.q);
    contacts_.carry_along();
    look(state_.q);
    const double dt = moment;
    constexpr int most = 120, slow = 40;
    constexpr double inexact = 1e-6;  // of v
    state_.v = zero_v_;
    const Vec lambda = lambda_;
    Vec ahead, behind, q, rows, dv, mu;
    double tau = 1, before = 0;
    const model::CoordinateSizes sizes = system_.coordinate_sizes();
    for (int i = 0; i < most; ++i) {
      unbalance(state_.t + dt, dt * state_.v, lambda, ahead);
      unbalance(state_.t - dt, -dt * state_.v, lambda, behind);
      ahead = (ahead - behind) / (2 * dt);
      system_.hold_still(false);
      system_.move_to(state_.t, state_.q, state_.v);
      rows = system_.g_dot();
      system_.hold_still(true);
      system_.move_to(state_.t, state_.q, zero_v_);
      system_.factorise({1 / (tau * tau), 0, 1}, zero_v_, lambda);
      if (!system_.correct(ahead, rows, dv, mu)) return undetermined(ahead);
      state_.v += dv;
      const double change = sizes.largest(dv), speed = sizes.largest(state_.v);
      if (change <= settled * speed) return {};
      if (i == 0) before = change;
      if ((i + 1) % slow != 0) continue;
      // Either the changes are round-off, or the motion works against weak springs, which less damping finds. Without
      // stiffness it accelerates without end.
      if (change <= inexact * speed) return {};
      if (!(change < before)) return undetermined(dv);
      before = change, tau *= 10;
    }
    return undetermined(dv);
  }

 private:
  Vec mass_times(const Vec& x) {
    Vec r = zero_v_;
    system_.add_mass_times(1, x, r);
    return r;
  }

  std::string undetermined(const Vec& x) {
    return fmt::format(
        "the equilibrium is not determined: it moves with time, and nothing holds {}, so its velocity there "
        "follows from nothing. Hold it by a joint, a spring or a contact, or start from positions and velocities of "
        "your own",
        direction(x));
  }

  // "bodies.rod in its angle": the body that x moves with the most energy, and its coordinates that have a tenth of it.
  std::string direction(const Vec& x) {
    const Vec energy = x.cwiseProduct(mass_times(x)).cwiseAbs();
    const model::BodyEntry* most = nullptr;
    for (const model::BodyEntry& body : system_.model().bodies)
      if (body.nv > 0 && (!most || energy.segment(body.v0, body.nv).sum() > energy.segment(most->v0, most->nv).sum()))
        most = &body;
    if (!most) return "what moves";
    const Vec own = energy.segment(most->v0, most->nv);
    std::string text;
    for (Eigen::Index k = 0; k < own.size(); ++k)
      if (own[k] >= 0.1 * own.sum()) text += (text.empty() ? "" : ", ") + coordinate(*most, k);
    return fmt::format("bodies.{} in {}", most->name, text);
  }

  // Measured by the displacement of the body's first marker.
  std::string coordinate(const model::BodyEntry& body, Eigen::Index k) {
    const std::string number = fmt::format("its coordinate {} of {}", k + 1, body.nv);
    if (body.body->markers().empty()) return number;
    Motion m;
    body.body->motion(0, state_.t, state_.q.segment(body.q0, body.nq), zero_v_.segment(body.v0, body.nv), m);
    for (std::size_t j = 0; j < m.dofs.size(); ++j) {
      if (m.dofs[j] != k) continue;
      const Vec by = m.J.col(Eigen::Index(j));
      const Eigen::Index dim = m.x.size();
      Eigen::Index axis = 0;
      if (by.tail(by.size() - dim).cwiseAbs().maxCoeff(&axis) > 0)
        return dim == 2 ? "its angle" : fmt::format("its turn about {}", "xyz"[axis]);
      if (by.head(dim).cwiseAbs().maxCoeff(&axis) > 0) return fmt::format("{}", "xyz"[axis]);
    }
    return number;
  }

  // Moves the system to q at rest, finds a_ and lambda_ there, and returns |a| in the norm of the mass matrix.
  double look(const Vec& q) {
    system_.move_to(state_.t, q, zero_v_);
    const Vec right = -system_.f();
    system_.factorise({1, 0, 0}, zero_v_, Vec::Zero(system_.sizes().nc), Factors::projection);
    if (!system_.correct(right, Vec::Zero(system_.sizes().nc), a_, lambda_, Factors::projection))
      return std::numeric_limits<double>::infinity();
    const double unbalanced = std::sqrt(std::max(0.0, a_.dot(mass_times(a_))));
    scale_ = std::max(scale_, unbalanced);
    return unbalanced;
  }

  // dq_ and the resulting state, from the system's point.
  bool step(double tau, Vec& q_next) {
    residual_ = -system_.f();
    system_.add_reaction(1, lambda_, residual_);
    system_.factorise({1 / (tau * tau), 0, 1}, zero_v_, lambda_);
    Vec dlambda;
    if (!system_.correct(residual_, system_.g(), dq_, dlambda)) return false;
    system_.retract(state_.q, dq_, q_next);
    onto_rows(q_next);
    return true;
  }

  // The least change of q that satisfies the rows. (Violations left by a turn would count as a step against the
  // forces.)
  void onto_rows(Vec& q) {
    State s{state_.t, q, zero_v_, {}, {}};
    const model::CoordinateSizes sizes = system_.coordinate_sizes();
    // Rows are in metres, or in radians for angles.
    model::positions_onto_rows(system_, s, {.allowed = settled * std::min(1.0, sizes.length) * sizes.place, .most = 5});
    q = s.q;
  }

  // The residual G^T lambda - f at another time and place.
  void unbalance(double t, const Vec& dq, const Vec& lambda, Vec& r) {
    Vec q;
    system_.retract(state_.q, dq, q);
    system_.move_to(t, q, zero_v_);
    r = -system_.f();
    system_.add_reaction(1, lambda, r);
  }

  model::AssembledSystem& system_;
  State& state_;
  int nv_;
  Vec zero_v_;
  RestingContacts contacts_;
  TurnCounts turns_;
  Vec a_, lambda_, dq_, residual_;
  double scale_ = 0, slow_ = 1;  // slow_ [s]
};

}  // namespace

std::optional<std::string> find_equilibrium(model::AssembledSystem& system, State& state) {
  StaticEquilibrium rest(system, state);
  if (rest.settle()) return rest.follow();
  return fmt::format("no static equilibrium was found: {}", rest.culprit());
}

}  // namespace trammel::simulate
