// The lowest modes of large systems, from blocks of a Krylov subspace of the shifted inverse (Rayleigh-Ritz on V, T V, T^2 V, ...;
// Golub, Underwood 1977; Saad 2011, chapters 6 and 8):
//
//     undamped:  T x = (K - sigma M)^-1 M x,  self-adjoint in M, theta = 1/(omega^2 - sigma),  sigma < 0
//     else:      T (x, w) = (u, x + sigma u),  S u = -(M w + D x + sigma M x),  S = K + sigma D + sigma^2 M,
//                theta = 1/(lambda - sigma),  w = lambda x,  sigma > 0
//
// each inverse within G x = 0 by the system's own factorisation, so that storage and redundant rows are its affair. Blocks,
// because a single vector finds the copies of a multiple eigenvalue by round-off alone, and symmetric plates and free
// bodies have them; so neither ARPACK nor Spectra is used.
#pragma once

#include "modes/normal_modes.hpp"

namespace trammel::simulate {

// Throws model::NotSolvable: they did not converge, or the state is one in motion whose coordinates turn.
Spectrum krylov_modes(model::AssembledSystem& system, const State& state, int count);

}  // namespace trammel::simulate
