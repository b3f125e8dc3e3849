// What counts as 0 in a solution of the problem of contacts.
#pragma once

namespace trammel::simulate {

// Of the largest force in the island: a smaller force may be an error of the solution.
inline constexpr double most_error_of_forces = 1e-6;
// Forces and accelerations below `undecided` times the error of a solution cannot be distinguished from 0.
inline constexpr double undecided = 10;
// Relative to the largest acceleration in the island, which may cancel in the others.
inline constexpr double error_of_accelerations = 1e-12;
// Of the largest load of a group: a spare load may be negative by this round-off. An event shows that more is missing
// (critical_force in event_function.hpp).
inline constexpr double round_off_of_loads = 5e-10;

}  // namespace trammel::simulate
