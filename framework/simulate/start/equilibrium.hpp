// The state of rest that a run may start from, "initial": "equilibrium":
//
//     f(t, q) = G^T lambda,   g(t, q) = 0        with everything at rest and without friction
//
// Compliant contacts penetrate as far as their force requires; contacts with rows are closed where they push (gap = 0,
// force >= 0) and open elsewhere. Bodies that follow a law of time rest at their place, as if they moved infinitely
// slowly; the velocity of the state is then that of the equilibrium, q' from (d/dt of the equations above) = 0, with
// contacts that have friction carried along. For example, a body on a table that only translates starts with the
// table's velocity.
//
// Newton's method with the mass matrix as damping (pseudo-transient continuation; Kelley, Keyes, SIAM J. Numer. Anal.
// 35,
// 508 (1998)):   (K + M / tau^2) dq + G^T dlambda = f - G^T lambda,  G dq = -g.
// tau grows while the unbalanced acceleration a (the one with which the system would leave from rest) shrinks, and
// falls where a step would raise it or oppose it. So the method follows the forces, away from unstable equilibria, and
// ends as Newton's method. Directions without stiffness and load keep their coordinates. A direction without stiffness
// has no unique velocity while the equilibrium moves; the returned text then names it.
#pragma once

#include <optional>
#include <string>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Moves q of `state` to an equilibrium and sets v; contacts are left open. A text: why there is none nearby.
std::optional<std::string> find_equilibrium(model::AssembledSystem& system, State& state);

}  // namespace trammel::simulate
