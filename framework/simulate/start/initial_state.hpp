// The initial state of a run: the bodies' parameters, checked against the joints' rows, or moved onto them.
//
// The nearest state in the metric of kinetic energy: Gauss-Newton steps  min dq^T M dq  with  G dq = -g  until g = 0,
// then once
// min dv^T M dv  with  G dv = -(G v + g_t).
#pragma once

#include <trammel/integrator.hpp>

#include "run/settings.hpp"
#include "scene/value.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// t, q and v at the start. Rows violated by more than 1e-8 (m, rad; m/s, rad/s) are an error that states the violation
// and the change to the nearest consistent state; `project` takes that state, `equilibrium` a state of rest near it.
// The same applies to a contact that penetrates: the nearest state in which it touches is offered, or taken. There the
// metric includes the elastic energy,  min dq^T (M + K (1 s)^2) dq.
State initial_state(model::AssembledSystem& system, double t, Settings::Initial wanted, const scene::Value& root,
                    scene::Problems& problems);

}  // namespace trammel::simulate
