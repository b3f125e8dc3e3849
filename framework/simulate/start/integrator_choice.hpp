// The integrator of a scene that names none.
//
//     dop853, tolerance 1e-9               the usual choice: no step to choose; contacts and friction are events
//     the same with "rows": "projected"    where light bodies are tied to heavy ones (mass_ratio.hpp), and in runs over
//                                          1000 s, whose motions are slower than the stabilisation of the rows
//     hht_alpha, tolerance 1e-7            where explicit methods need more than a million steps, or with n > 10
//                                          coordinates more than 10/n million: it damps the fast motions
//     the same, tolerance 1e-5             with more than 100 coordinates: waves through elements are always in motion
//                                          (1e-5 m on a steel plate of 326 under a ball) and would be resolved at 1e-7
//
// The choice follows from the model at its start (fastest_motion.hpp) and the duration of the run, so the same scene
// always has the same integrator. A resumed run, whose end may have moved, keeps its integrator.
#pragma once

#include "simulate/start/setup.hpp"

namespace trammel::simulate {

// `setup` has the first of these. Replaces it if another one fits better, or if the resumed run had another one,
// `before` (empty: not resumed). setup.choice states the choice and its reason.
void choose_integrator(Setup& setup, model::AssembledSystem& system, const std::string& before,
                       plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::simulate
