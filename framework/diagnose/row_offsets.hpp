// Violations of rows, in metres and radians.
//
// A row is scaled to be a length or an angle near g = 0: (|d|^2/L - L)/2 for a rod, sin(delta) for an axis. Farther
// away the violation follows from s, the row's gradient by the motion of a marker, which is 1 where the row is
// satisfied:
//
//     |d| - L = 2 g/(1 + s),   s = |d|/L        delta = atan2(g, s),   s = cos(delta)        their rates: g_dot/s
//
// Rows of a body are treated alike, with s relative to the gradient where they are satisfied. Rows between more than
// two markers, whose scale depends on the scene, are given as they are.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct RowOffset {
  double position = 0, velocity = 0;  // [m], [m/s]; [rad], [rad/s]
  bool angle = false;
};

// The system is at `state`.
std::vector<RowOffset> row_offsets(model::AssembledSystem& system, const model::RowGroup& rows, const State& state);
RowOffset row_offset(model::AssembledSystem& system, const model::RowLimit& limit, double t);

// Rows of a joint that no motion of its markers changes in first order, such as the distance of coinciding markers.
// They have no effect there, but act as soon as the markers part: there are no equations of motion.
std::vector<int> rows_without_direction(model::AssembledSystem& system, const model::JointEntry& joint, double t);

// The norms of all rows, without distinction of units: (m, rad) and (m/s, rad/s).
struct Offset {
  double position = 0, velocity = 0;
};
Offset norm(const std::vector<RowOffset>& rows);

}  // namespace trammel::simulate
