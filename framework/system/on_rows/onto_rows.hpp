// A state onto the rows by Newton's method: the least changes in the metric of S that satisfy them.
//
//     q := q (+) dq,   [S G^T; G 0] (dq, mu) = -(0, g)               factors at each iterate
//     v := v + dv,     [S G^T; G 0] (dv, mu) = -(0, G v + g_t)       linear; twice, to reduce round-off
//
// Positions end at the rows' round-off: `rounding` of the largest coordinate, since rows are differences of
// coordinates, and of the coordinates that the row itself has, each by its size (coordinate_sizes.hpp), so that an
// angle is not met as a distance of a kilometre is, nor a distance of a micrometre as an angle; or, where the rows are
// within `allowed`, as soon as an iteration does not halve what is left: Newton's method converges quadratically until
// there is only round-off.
//
// The integrators' and corrections' own iterations are others: they keep factors from one iterate to the next.
#pragma once

#include <functional>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::model {

inline constexpr Blend by_mass = {1, 0, 0};
inline constexpr Blend by_coordinates = {.c_m = 0, .c_1 = 1};

struct OntoRows {
  Blend metric = by_mass;
  double allowed = 0;  // [m, rad] largest |g_i| of a state that counts as on the rows
  int most = 50;       // iterations
  // dv/dq of a change dq from the state, times dq, where the velocities turn with it; empty: v stays.
  std::function<Vec(const State&, const Vec& dq)> along = {};
};

// False: the rows are not within `allowed` in the end. The system is left at the state.
bool positions_onto_rows(AssembledSystem& system, State& state, const OntoRows& how);
// False: the matrix is singular.
bool velocities_onto_rows(System& system, State& state, Blend metric = by_mass);

}  // namespace trammel::model
