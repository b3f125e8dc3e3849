#include "simulate/start/latch_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "diagnose/row_offsets.hpp"
#include "system/on_rows/onto_rows.hpp"
#include "system/point/pseudo_random.hpp"

namespace trammel::simulate {
namespace {

constexpr int most_rows = 1000;
constexpr int attempts = 4;              // from the start, and from places beside it
constexpr double off_rows = 1e-9;        // of the coordinates' sizes: the gap is computed on the rows but for this
constexpr double along_the_rows = 1e-3;  // of a change of the gap by 1: a direction that misses more is none

class Approach {
 public:
  enum class End { reached, stationary, unknown };

  Approach(model::AssembledSystem& system, double t, int contact) : system_(system), t_(t), contact_(contact) {
    open_.contacts.resize(system.model().contacts.size());
    sizes_ = system.coordinate_sizes();
  }

  // Reduces the gap from q, which is near the rows.
  End from(Vec q) {
    constexpr int most_steps = 200;
    constexpr double enough = 1e-5;       // of the first gap: counts as reached
    constexpr double least_sine = 1e-4;   // of the angle between the gap's gradient and the rows: stationary to 1e-8
    constexpr double least_change = 0.1;  // of the linear prediction of a step
    double longest = 0.1;                 // change of a coordinate in a step, relative to its size
    if (!restore(q)) return End::unknown;
    const double first = gap_;
    for (int i = 0; i < most_steps; ++i) {
      if (gap_ <= enough * first) return End::reached;
      const double gap = gap_, sine = closing_direction(q);
      if (!std::isfinite(sine)) return End::unknown;
      if (sine < least_sine) return End::stationary;
      const double size = sizes_.largest(closing_), by = std::min(gap, longest / size);
      Vec tried;
      system_.retract(q, by * closing_, tried);
      if (restore(tried) && gap_ < gap - least_change * by) {
        q = tried;
        longest *= 2;
      } else {
        gap_ = gap;
        longest = by * size / 2;
      }
    }
    return End::unknown;
  }
  double gap() const { return gap_; }

 private:
  // Moves q onto the rows and computes its gap.
  bool restore(Vec& q) {
    system_.set_modes(open_);
    State s{t_, q, Vec::Zero(system_.sizes().nv), {}, {}};
    const double allowed = off_rows * std::min(1.0, sizes_.length) * sizes_.place;
    const bool found =
        model::positions_onto_rows(system_, s, {.metric = model::by_coordinates, .allowed = allowed, .most = 10});
    q = s.q;
    gap_ = system_.gap(contact_);
    return found && std::isfinite(gap_);
  }

  // Sets closing_ to the change of least norm that keeps the rows and reduces the gap by 1. Returns the sine of the
  // angle between the gap's gradient and the rows.
  double closing_direction(const Vec& q) {
    model::Modes held = open_;
    held.contacts[std::size_t(contact_)].closed = true;
    held.contacts[std::size_t(contact_)].offset = gap_;
    system_.set_modes(held);
    const Vec still = Vec::Zero(system_.sizes().nv), no_force = Vec::Zero(system_.sizes().nc);
    system_.move_to(t_, q, still);
    const Vec wanted = Vec::Unit(system_.sizes().nc, system_.row({contact_, 0}));
    Vec mu, gradient = still, change = no_force;
    system_.add_rows_force(1, wanted, gradient);
    system_.factorise(model::by_coordinates, still, no_force, Factors::projection);
    if (!system_.correct(still, wanted, closing_, mu, Factors::projection))
      return std::numeric_limits<double>::quiet_NaN();
    system_.add_rows_times(1, closing_, change);
    // Otherwise the gap's gradient counts as one of the rows.
    const bool closes = (change + wanted).lpNorm<Eigen::Infinity>() < along_the_rows;
    return closes ? 1 / (gradient.norm() * closing_.norm()) : 0;
  }

  model::AssembledSystem& system_;
  double t_;
  int contact_;
  model::Modes open_;
  model::CoordinateSizes sizes_;
  Vec closing_;
  double gap_ = 0;
};

bool is_latch(const model::ContactEntry& contact) {
  return contact.restitution && contact.restitution->treatment().release == Restitution::Release::never &&
         !contact.surface;
}

bool rows_depend_on_time(model::AssembledSystem& system, const State& start, double until, int contact) {
  const Vec still = Vec::Zero(start.v.size());
  Vec first;
  for (const double part : {0.0, 0.37, 1.0}) {
    system.move_to(start.t + part * (until - start.t), start.q, still);
    Vec now(system.sizes().nc + 1);
    now << system.g(), system.gap(contact);
    if (part == 0) first = now;
    if (!(now == first)) return true;
  }
  return false;
}

// [m, rad] The smallest gap of a latch that cannot lock; empty: it can, or this is unknown.
std::optional<double> nearest_if_never(model::AssembledSystem& system, const State& start, int contact) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Vec q = start.q;
    system.move_to(start.t, start.q, start.v);
    const Vec aside = model::pseudo_random(start.v.size(), 0.1, attempt);
    if (attempt > 0) system.retract(start.q, aside.cwiseProduct(system.coordinate_sizes().of), q);
    Approach approach(system, start.t, contact);
    if (approach.from(q) != Approach::End::stationary) return {};
    const auto& limit = system.model().contacts[std::size_t(contact)].limit;
    nearest = std::min(nearest, limit ? std::abs(row_offset(system, *limit, start.t).position) : approach.gap());
  }
  return nearest;
}

}  // namespace

void check_latches(model::AssembledSystem& system, const State& start, double until, const scene::Value& root,
                   scene::Problems& problems) {
  if (system.sizes().nc > most_rows) return;
  const model::Modes before = system.modes();
  for (int i = 0; i < int(system.model().contacts.size()); ++i) {
    const model::ContactEntry& contact = system.model().contacts[std::size_t(i)];
    if (!is_latch(contact) || rows_depend_on_time(system, start, until, i)) continue;
    const std::optional<double> nearest = nearest_if_never(system, start, i);
    system.set_modes(before);
    if (!nearest) continue;
    const scene::Value* at = root.at_path("contacts." + contact.name);
    problems.error((at ? *at : root)
                       .problem(fmt::format("this latch can never lock: the joints let its gap come no nearer to 0 "
                                            "than {:.6g} (m, rad)",
                                            *nearest)));
  }
  system.move_to(start.t, start.q, start.v);
}

}  // namespace trammel::simulate
