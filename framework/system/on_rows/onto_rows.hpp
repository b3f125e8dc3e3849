// Moves a state onto the rows by Newton's method: the least changes in the metric of S that satisfy them.
//
//     q := q (+) dq,   [S G^T; G 0] (dq, mu) = -(0, g)               factors at each iterate
//     v := v + dv,     [S G^T; G 0] (dv, mu) = -(0, G v + g_t)       linear; twice, to reduce round-off
//
// Positions end at the rows' round-off: `rounding` times the largest coordinate, since rows are differences of
// coordinates, and times the coordinates in the row itself. All are measured by their sizes (coordinate_sizes.hpp), so
// that an angle need not be as inexact as a distance of a kilometre, nor a distance of a micrometre as an angle. If the
// rows are within `allowed`, the iteration also ends as soon as it does not halve the violation: Newton's method
// converges quadratically until only round-off is left.
//
// Integrators and corrections have iterations of their own, which keep factors from one iterate to the next.
#pragma once

#include <functional>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::model {

inline constexpr Blend by_mass = {1, 0, 0};
inline constexpr Blend by_coordinates = {.c_m = 0, .c_1 = 1};

struct OntoRows {
  Blend metric = by_mass;
  double allowed = 0;  // [m, rad] a state with |g_i| up to this counts as on the rows
  int most = 50;       // iterations
  // The change of v by a change dq, (dv/dq) dq, if velocities turn with the configuration; empty: v is unchanged.
  std::function<Vec(const State&, const Vec& dq)> along = {};
};

// False: the rows are not within `allowed` at the end. The system is left at the state.
bool positions_onto_rows(AssembledSystem& system, State& state, const OntoRows& how);
// False: the matrix is singular.
bool velocities_onto_rows(System& system, State& state, Blend metric = by_mass);

}  // namespace trammel::model
