// Corrections: each level reaches what it is for, by a small change, and leaves the rest alone.
#include <fmt/format.h>

#include <cmath>

#include <trammel/correction.hpp>

#include "testing/difference.hpp"
#include "testing/kit/components/components.hpp"
#include "testing/kit/integrators/problems.hpp"

namespace trammel::kit {

namespace {

constexpr ClaimsOf correction_claim{"correction.", "trammel/correction.hpp"};
using Level_ = Correction::Level;

// The end of a step that is off the rows by about `off`, and what comes out.
struct Corrected {
  Problem problem;
  std::unique_ptr<System> system;
  State now, off, state;
  Outcome outcome = Outcome::accept();
  double energy = 0;

  Corrected(const Subject& s, Level_ level, double size, const Problem& p) : problem(p), system(p.system()) {
    std::mt19937 random = s.random(41);
    now = problem.solution(0), off = problem.solution(0.02);
    for (Eigen::Index i = 0; i < off.v.size(); ++i) {
      if (level == Level_::position) off.q(i) += size * between(random, -1, 1);
      off.v(i) += size * between(random, -1, 1);
    }
    const auto correction = s.maker<Correction>()();
    state = off;
    energy = problem.energy.value ? problem.energy.value(now) : 0;
    correction->restart(*system, now);
    outcome = correction->apply(level, *system, {now, off, energy}, state);
  }
  Vec g(const State& x) {
    system->move_to(x.t, x.q, x.v);
    return system->g();
  }
  Vec g_dot(const State& x) {
    system->move_to(x.t, x.q, x.v);
    return system->g_dot();
  }
};

std::function<std::string(const Subject&)> unless_it_corrects(Level_ level, const char* name) {
  return [=](const Subject& s) {
    return s.maker<Correction>()()->corrects(level) ? std::string() : fmt::format("corrects(Level::{}) = false", name);
  };
}

constexpr double size = 1e-4;  // [m, m/s] as a coarse step leaves

// Rows by themselves, by a repeated row, and moving rows.
std::vector<Problem> problems_with_rows(const Subject& s) {
  return {some_rod(s), some_rod(s, {1, 2}), some_turning_wire(s)};
}

Report restores_positions(const Subject& s) {
  return compare("g = 0 after the correction, within 1e-9 m", [&](Comparison& c) {
    for (const Problem& problem : problems_with_rows(s)) {
      Corrected done(s, Level_::position, size, problem);
      c.holds(bool(done.outcome), fmt::format("{}: rejected: {}", problem.name, done.outcome.reason()));
      const double before = done.g(done.off).norm(), after = done.g(done.state).norm();
      c.holds(after <= 1e-9, fmt::format("{}: |g| = {:.3e} m, before {:.3e} m", problem.name, after, before));
      c.holds(same_bits(done.state.v, done.off.v), problem.name + ": v changed");
    }
  });
}

Report restores_velocities(const Subject& s) {
  return compare("G v + g_t = 0 after the correction, within 1e-9 m/s", [&](Comparison& c) {
    for (const Problem& problem : problems_with_rows(s)) {
      Corrected done(s, Level_::velocity, size, problem);
      c.holds(bool(done.outcome), fmt::format("{}: rejected: {}", problem.name, done.outcome.reason()));
      const double before = done.g_dot(done.off).norm(), after = done.g_dot(done.state).norm();
      c.holds(after <= 1e-9,
              fmt::format("{}: |G v + g_t| = {:.3e} m/s, before {:.3e} m/s", problem.name, after, before));
      c.holds(same_bits(done.state.q, done.off.q), problem.name + ": q changed");
    }
  });
}

bool keeps_momentum(const Correction& correction) {
  const auto* needs = dynamic_cast<const NeedsMomentum*>(&correction);
  return needs && needs->needs_momentum();
}

// A pendulum's speed is all momentum about its pivot, so one that keeps momentum is asked about a free pair of masses.
Report restores_energy(const Subject& s) {
  const bool momentum = keeps_momentum(*s.maker<Correction>()());
  return compare("the energy is that of the balance, the rows' rates as before", [&](Comparison& c) {
    const Problem problem = momentum ? some_spring_pair(s) : some_rod(s);
    Corrected done(s, Level_::energy, size, problem);
    c.holds(bool(done.outcome), fmt::format("rejected: {}", done.outcome.reason()));
    const double before = std::abs(problem.energy.value(done.off) - done.energy),
                 after = std::abs(problem.energy.value(done.state) - done.energy);
    // Round-off of energies of some 10 J, and a correction that is not iterated to the last digit.
    c.holds(after <= 1e-9 * problem.energy.scale, fmt::format("{:.3e} J off, before {:.3e} J", after, before));
    c.holds(same_bits(done.state.q, done.off.q), "q changed");
    const double moved = (done.g_dot(done.state) - done.g_dot(done.off)).norm();
    c.holds(moved <= 1e-9, fmt::format("G v + g_t changed by {:.3e} m/s", moved));
    if (!momentum) return;
    const Vec gained = problem.rigid_motions(done.off.q).transpose() * problem.M * (done.state.v - done.off.v);
    c.holds(gained.norm() <= 1e-12, fmt::format("the momentum changed by {:.3e} N s", gained.norm()));
  });
}

// Whatever the metric, a correction of second order in the violation would be as small as wanted: twice is too much.
Report is_small(const Subject& s) {
  const auto correction = s.maker<Correction>()();
  return compare(
      "the change is of the violation's size, and nothing is left for a second correction", [&](Comparison& c) {
        for (const Level_ level : {Level_::position, Level_::velocity}) {
          if (!correction->corrects(level)) continue;
          for (const double violation : {1e-3, 1e-6}) {
            const Problem problem = some_rod(s);
            Corrected done(s, level, violation, problem);
            const double change = std::hypot((done.state.q - done.off.q).norm(), (done.state.v - done.off.v).norm());
            // Off by up to sqrt(2) of it, and by rotation of a speed of 5 m/s with the positions' correction.
            c.holds(change <= 10 * violation, fmt::format("{:.3e} for a violation of {:.0e}", change, violation));
            State again = done.state;
            const auto fresh = s.maker<Correction>()();
            fresh->restart(*done.system, done.now);
            const Outcome outcome = fresh->apply(level, *done.system, {done.now, done.state, done.energy}, again);
            const double second = std::hypot((again.q - done.state.q).norm(), (again.v - done.state.v).norm());
            c.holds(outcome && second <= 1e-9, fmt::format("a second correction still changes {:.3e}", second));
          }
        }
      });
}

// By d'Alembert: a correction by the rows' own forces does no work on motions that the rows allow.
Report leaves_free_motion(const Subject& s) {
  const auto correction = s.maker<Correction>()();
  Report report;
  const Problem problem = some_rod(s);
  for (const Level_ level : {Level_::position, Level_::velocity}) {
    if (!correction->corrects(level)) continue;
    Corrected done(s, level, 1e-5, problem);
    const Vec change = level == Level_::position ? done.state.q - done.off.q : done.state.v - done.off.v;
    const Eigen::Vector2d along(-done.off.q(1), done.off.q(0));  // the free direction of a pendulum
    const double share = std::abs(along.dot(change)) / (along.norm() * change.norm() + 1e-300);
    report.claim(fmt::format("the {} change by the rows, not along the free motion",
                             level == Level_::position ? "positions" : "velocities"),
                 change.norm() <= 1e-12 || share <= 1e-3, fmt::format("share along it {:.2e}", share));
  }
  return report;
}

Report rejects_nan(const Subject& s) {
  const auto correction = s.maker<Correction>()();
  const Problem problem = some_rod(s);
  Report report;
  for (const Level_ level : {Level_::position, Level_::velocity}) {
    if (!correction->corrects(level)) continue;
    const auto system = problem.system();
    const State now = problem.solution(0);
    State off = now;
    off.q(0) = std::nan("");
    State state = off;
    const Outcome outcome = correction->apply(level, *system, {now, off, 0}, state);
    report.claim("a state that is not a number is rejected, or left as it is",
                 !outcome || !state.q.allFinite() || !state.v.allFinite(), "it became one that looks right");
  }
  return report;
}

Report does_nothing_without_rows(const Subject& s) {
  const auto correction = s.maker<Correction>()();
  const Problem problem = flight(some_rod(s));
  Report report;
  for (const Level_ level : {Level_::position, Level_::velocity}) {
    if (!correction->corrects(level)) continue;
    Corrected done(s, level, size, problem);
    report.claim("without rows (nc = 0) the state stays as it is",
                 done.outcome && same_bits(done.state.q, done.off.q) && same_bits(done.state.v, done.off.v));
  }
  return report;
}

std::string has_only_the_energy(const Subject& s) {
  const auto correction = s.maker<Correction>()();
  return correction->corrects(Level_::position) || correction->corrects(Level_::velocity)
             ? ""
             : "it corrects neither positions nor velocities";
}

}  // namespace

Checks correction_checks() {
  const char* const state = "Corrects q or v of `state`, which is the step's end on entry";
  return {
      {correction_claim("restores-positions", "The corrected position satisfies the rows.", "g(t, q) = 0",
                        "moves q so that g(t, q) = 0"),
       Level::quick, restores_positions, unless_it_corrects(Level_::position, "position")},
      {correction_claim("restores-velocities", "The corrected velocity satisfies the rows.", "G v + g_t = 0",
                        "moves v so that G v + g_t = 0, at the final q"),
       Level::quick, restores_velocities, unless_it_corrects(Level_::velocity, "velocity")},
      {correction_claim("restores-the-energy", "The corrected velocity has the energy of the balance.",
                        "E(q, v') = E_start + supplied - dissipated,  G v' = G v",
                        "moves v so that the energy agrees with the balance and G v + g_t does not change"),
       Level::quick, restores_energy, unless_it_corrects(Level_::energy, "energy")},
      {correction_claim("is-as-small-as-the-violation", "The change is of the violation's size.",
                        "|dq| = O(|g|), |dv| = O(|G v + g_t|)", state),
       Level::quick, is_small, has_only_the_energy},
      {correction_claim("leaves-the-free-motion", "The motion that the rows allow is not changed.",
                        "n^T M dq = 0 for G n = 0, to first order", state),
       Level::quick, leaves_free_motion, has_only_the_energy},
      {correction_claim("does-nothing-without-rows", "Without rows nothing changes.", "nc = 0: dq = 0, dv = 0", state),
       Level::quick, does_nothing_without_rows, has_only_the_energy},
      {correction_claim("invents-no-state", "What is not a number does not become one.", "q = NaN: reject, or q = NaN",
                        "A rejection ends the run."),
       Level::quick, rejects_nan, has_only_the_energy}};
}

}  // namespace trammel::kit
