// The integrator of a scene that names none.
//
//     dop853, tolerance 1e-9                        as a rule: no step need be chosen, and contacts and friction are located as events
//     the same with "rows": "projected"             where light bodies are tied to heavy ones (mass_ratio.hpp)
//     hht_alpha, tolerance 1e-7                     where explicit steps would be more than a million: it does not follow what is
//                                                   fast beside the rest, and damps it
//
// Decided from the model at its start (fastest_motion.hpp) against the time that the run spans, so the same scene has the same. A
// resumed run, whose end may have moved, keeps what it had.
#pragma once

#include "simulate/start/setup.hpp"

namespace trammel::simulate {

// Replaces the first of these, which `setup` has, where another fits, or where setup.chosen was another `before` (empty: never), and
// says in setup.choice what was chosen and why.
void choose_integrator(Setup& setup, model::AssembledSystem& system, const std::string& before,
                       plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::simulate
