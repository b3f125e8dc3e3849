// Markers that a joint or force turns although the functions of their body have no moment there (NaturalBoundary).
//
//     a joint turns a marker if H of one of its rows has an angular part at the marker;
//     a force does if its wrench has a moment there, at the start or at a place, speed and time nearby
//
// If a row or wrench also has a linear part, levers below a hundredth of the scene's length do not count.
#pragma once

#include <string>
#include <vector>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// A sentence for each such marker, with the setting that adds the functions. Leaves the system at the start.
std::vector<std::string> turned_boundaries(model::AssembledSystem& system, const State& start, double until);

}  // namespace trammel::simulate
