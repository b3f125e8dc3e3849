// The state of rest that a run may start from, "initial": "equilibrium":
//
//     f(t, q) = G^T lambda,   g(t, q) = 0        with everything at rest and without friction
//
// Compliant contacts push as deep as they must; contacts with rows are closed where they push (gap = 0, force >= 0) and open
// elsewhere. What moves by a law of time stands still at its place, as if it moved infinitely slowly; the velocity of the
// state is that of the equilibrium then, q' along (d/dt of the equations above) = 0, with contacts that have friction carried
// along. So a body on a table that only translates starts with the table's velocity: at rest relative to it.
//
// Newton's method with the mass matrix as damping (pseudo-transient continuation; Kelley, Keyes, SIAM J. Numer. Anal. 35,
// 508 (1998)):   (K + M / tau^2) dq + G^T dlambda = f - G^T lambda,  G dq = -g.
// tau grows while the unbalanced acceleration a (the one with which the system would leave from rest) shrinks, and falls where
// a step would raise it or go against it; so the method moves with the forces, away from unstable equilibria, and ends as
// Newton's. A direction that nothing holds and nothing pushes keeps its coordinates. One that nothing holds while the equilibrium
// moves has no velocity of its own; then there is a text that names it.
#pragma once

#include <optional>
#include <string>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Moves q from where `state` is to an equilibrium and sets v; contacts are left open. A text: there is none near, and why.
std::optional<std::string> find_equilibrium(model::AssembledSystem& system, State& state);

}  // namespace trammel::simulate
