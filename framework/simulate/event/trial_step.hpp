// One trial step of an integrator, with a check that the result has the system's sizes.
#pragma once

#include <string>

#include <trammel/integrator.hpp>

namespace trammel::simulate {

// As integrator.step(system, now, h, next). Throws BadStep if `next` has vectors of a wrong size.
Outcome trial_step(Integrator& integrator, System& system, const State& now, double h, State& next);

// "q[2] = nan": the first number of `next` that is not finite; empty: all are.
std::string not_finite_in(const State& next);

// True if the integrator returns finite numbers (or rejects) with some far shorter step from `now`: then its step was
// too long; otherwise the integrator is to blame. By the contract such trials leave no trace.
bool finite_with_shorter_steps(Integrator& integrator, System& system, const State& now, double h, State& scratch);

}  // namespace trammel::simulate
