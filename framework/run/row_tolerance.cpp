#include "run/row_tolerance.hpp"

#include <algorithm>

#include "run/contact_scale.hpp"

namespace trammel::simulate {

namespace {

constexpr double digits = 1e-8;      // of lengths and speeds: those that a scene is written with
constexpr double well_below = 1e-3;  // of them: where an iteration may end

}  // namespace

RowTolerance row_tolerance(model::AssembledSystem& system, const State& s) {
  system.move_to(s.t, s.q, s.v);
  ContactScale all(system.model());
  all.take_all(system);
  const Scale& scale = all.scene();
  const double unit = scale.length() > 0 ? std::min(1.0, scale.length()) : 1;
  const double speed = s.v.size() > 0 ? s.v.norm() : 0;
  // The error of a direction between markers is the round-off of their place over their distance.
  const double turned = scale.gaps_and_bodies > 0 ? std::min(1.0, scale.resolution() / scale.gaps_and_bodies) : 0;
  return {digits * unit + scale.resolution(), digits * std::max(unit, speed) + turned * speed,
          well_below * digits + 64 * scale.resolution(), RowTolerance::of_acceleration * unit + scale.resolution()};
}

}  // namespace trammel::simulate
