// The state of rest that a run may start from, "initial": "equilibrium":
//
//     f(t, q) = G^T lambda,   g(t, q) = 0        with everything at rest and without friction
//
// Compliant contacts penetrate as far as their force requires; contacts with rows are closed where they push (gap = 0,
// force >= 0) and open elsewhere. Bodies that follow a law of time rest at their place, as if they moved infinitely
// slowly. The velocity of the state is that of the moving equilibrium, q' from d/dt of the equations above, in which
// contacts with friction stick. For example, a body on a table that only translates starts with the table's velocity.
//
// Newton's method with the mass matrix as damping (pseudo-transient continuation; Kelley, Keyes, SIAM J. Numer. Anal.
// 35, 508 (1998)):
//
//     (K + M / tau^2) dq + G^T dlambda = f - G^T lambda,  G dq = -g
//
// tau grows while the unbalanced acceleration a (with which the system would leave its rest) decreases. It is reduced
// where a step would increase a or go against it. So the method follows the forces, away from unstable equilibria, and
// ends as Newton's method. Directions without stiffness and load keep their coordinates. A direction without stiffness
// has no unique velocity while the equilibrium moves; the returned text then names it.
#pragma once

#include <optional>
#include <string>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Moves q of `state` to an equilibrium and sets v; contacts are left open. Returns a text if there is none nearby.
std::optional<std::string> find_equilibrium(model::AssembledSystem& system, State& state);

}  // namespace trammel::simulate
