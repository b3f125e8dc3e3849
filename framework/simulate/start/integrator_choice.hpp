// The integrator of a scene that names none.
//
//     dop853, tolerance 1e-9                        as a rule: no step need be chosen, and contacts and friction are located as events
//     the same with "rows": "projected"             where light bodies are tied to heavy ones (mass_ratio.hpp)
//     hht_alpha, tolerance 1e-7                     where explicit steps would be more than a million, or of n > 10 coordinates more
//                                                   than 10/n million: it does not follow what is fast beside the rest, and damps it
//     the same, tolerance 1e-5                      of more than 100 coordinates: waves through elements are always in motion, on a steel
//                                                   plate of 326 under a ball with 1e-5 m, and at 1e-7 they would be followed
//
// Decided from the model at its start (fastest_motion.hpp) and the duration of the run, so the same scene always has
// the same integrator. A resumed run, whose end may have moved, keeps its integrator.
#pragma once

#include "simulate/start/setup.hpp"

namespace trammel::simulate {

// Replaces the first of these, which `setup` has, if another one fits better, or if a resumed run had another, `before`
// (empty: not resumed); setup.choice states the choice and its reason.
void choose_integrator(Setup& setup, model::AssembledSystem& system, const std::string& before,
                       plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::simulate
