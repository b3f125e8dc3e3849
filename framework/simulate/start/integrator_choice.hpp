// The integrator of a scene that names none.
//
//     dop853, tolerance 1e-9                        as a rule: no step need be chosen, and contacts and friction are located as events
//     the same with "rows": "projected"             where light bodies are tied to heavy ones (mass_ratio.hpp)
//     hht_alpha, tolerance 1e-7                     where explicit steps would be more than a million, or of n > 10 coordinates more
//                                                   than 10/n million: it does not follow what is fast beside the rest, and damps it
//     the same, tolerance 1e-5                      of more than 100 coordinates: waves through elements are always in motion, on a steel
//                                                   plate of 326 under a ball with 1e-5 m, and at 1e-7 they would be followed
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
