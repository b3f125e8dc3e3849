// By how much rows are off, in metres and radians.
//
// A row is scaled to be a length or an angle where it nearly holds: a rod's is (|d|^2/L - L)/2, an axis' sin(delta). Further off its
// gradient by the motion of a marker tells, s, which is 1 where the row holds:
//
//     |d| - L = 2 g/(1 + s),   s = |d|/L        delta = atan2(g, s),   s = cos(delta)        their rates: g_dot/s
//
// A body's own rows are told alike, s beside the gradient where they hold. Rows between more than two markers, whose scale is a
// scene's own, are told as they are.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct RowOffset {
  double position = 0, velocity = 0;  // [m], [m/s]; [rad], [rad/s]
  bool angle = false;
};

// At the state, where the system is.
std::vector<RowOffset> row_offsets(model::AssembledSystem& system, const model::RowGroup& rows, const State& state);
RowOffset row_offset(model::AssembledSystem& system, const model::RowLimit& limit, double t);

// The norms of all, without their kinds: (m, rad) and (m/s, rad/s).
struct Offset {
  double position = 0, velocity = 0;
};
Offset norm(const std::vector<RowOffset>& rows);

}  // namespace trammel::simulate
