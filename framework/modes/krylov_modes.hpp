// The lowest modes of large systems, from blocks of a Krylov subspace of the shifted inverse (Rayleigh-Ritz on V, T V,
// T^2 V, ...; Golub, Underwood 1977; Saad 2011, chapters 6 and 8):
//
//     undamped:  T x = (K - sigma M)^-1 M x,  self-adjoint in M, theta = 1/(omega^2 - sigma),  sigma < 0
//     else:      T (x, w) = (u, x + sigma u),  S u = -(M w + D x + sigma M x),  S = K + sigma D + sigma^2 M,
//                theta = 1/(lambda - sigma),  w = lambda x,  sigma > 0
//
// The system's own factorisation applies each inverse within G x = 0, with its storage and its treatment of redundant
// rows. Blocks are needed for multiple eigenvalues, which symmetric plates and free bodies have: iterations with a
// single vector, as in ARPACK and Spectra, find the copies by round-off only.
#pragma once

#include "modes/normal_modes.hpp"

namespace trammel::simulate {

// Throws model::NotSolvable if they do not converge, or if the state moves and its coordinates turn.
Spectrum krylov_modes(model::AssembledSystem& system, const State& state, int count);

}  // namespace trammel::simulate
