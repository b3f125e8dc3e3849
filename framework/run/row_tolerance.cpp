#include "run/row_tolerance.hpp"

#include <algorithm>

#include "run/contact_scale.hpp"

namespace trammel::simulate {

RowTolerance row_tolerance(model::AssembledSystem& system, const State& s) {
  constexpr double digits = 1e-8;
  system.move_to(s.t, s.q, s.v);
  ContactScale all(system.model());
  all.take_all(system);
  const Scale& scale = all.scene();
  const double unit = scale.length() > 0 ? std::min(1.0, scale.length()) : 1;
  const double speed = s.v.size() > 0 ? s.v.norm() : 0;
  // The error of a direction between markers is the round-off of their place over their distance.
  const double turned = scale.gaps_and_bodies > 0 ? std::min(1.0, scale.resolution() / scale.gaps_and_bodies) : 0;
  return {digits * unit + scale.resolution(), digits * std::max(unit, speed) + turned * speed,
          1e-3 * digits + 64 * scale.resolution(), RowTolerance::of_acceleration * unit + scale.resolution()};
}

}  // namespace trammel::simulate
