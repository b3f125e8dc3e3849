// The claims of integrators that the kit measures, one function each; catalogue in integrators.cpp.
#pragma once

#include "testing/flow.hpp"
#include "testing/kit/integrators/problems.hpp"
#include "testing/kit/subject.hpp"

namespace trammel::kit {

Checks integrator_checks();

// contract.cpp
Report trial_leaves_no_trace(const Subject& s);
Report reads_nothing_from_next(const Subject& s);
Report takes_an_earlier_trial(const Subject& s);
Report resumes_bitwise(const Subject& s);
Report restart_forgets(const Subject& s);
Report keeps_its_order_when_rows_come_and_go(const Subject& s);
Report keeps_its_order_when_coordinates_change(const Subject& s);
Report stands_still_with_nothing_to_move(const Subject& s);
Report moves_on_in_time(const Subject& s);
Report does_not_depend_on_the_time_of_day(const Subject& s);
Report does_not_depend_on_the_order_of_coordinates(const Subject& s);
Report does_not_depend_on_the_unit_of_length(const Subject& s);
Report iterates_only_if_implicit(const Subject& s);

// extremes.cpp
Report any_step_is_finite_or_rejected(const Subject& s);
Report rejects_what_is_not_a_number(const Subject& s);
Report survives_any_failure(const Subject& s);
Report takes_any_mass_ratio(const Subject& s);
Report takes_any_time(const Subject& s);
Report allocates_nothing(const Subject& s);

// abilities.cpp
Report energy_error_shrinks(const Subject& s);
Report holds_its_rows(const Subject& s, const Problem& problem);
Report is_stable_for_small_steps(const Subject& s);
Report estimates_its_error(const Subject& s, const Problem& problem, double omega, double step);
Report dense_output_meets_the_ends(const Subject& s);
Report dense_output_has_an_order(const Subject& s);
Report dense_output_is_that_of_the_step(const Subject& s);

// Steps per second of a motion of 1 rad/s at which a method of this order is in its asymptotic range, well above
// round-off.
double steps_per_radian(int order);

}  // namespace trammel::kit
