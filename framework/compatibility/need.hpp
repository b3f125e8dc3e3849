// What a scene may need of its integrator, and whether an integrator has it.
#pragma once

#include <array>

#include <trammel/integrator.hpp>

namespace trammel::compatibility {

enum class Need {
  rows,            // joints, bodies with rows of their own, contacts that are closed by a row
  redundant_rows,  // rows that depend on each other
  friction,        // friction that sticks, decided at events
  jumps,           // friction decided at every evaluation
  rotations,       // unit quaternions among the coordinates
  events,          // contacts, friction that sticks, refinement
  error_estimate,  // a tolerance instead of a step's length
};
inline constexpr std::array every_need = {Need::rows,      Need::redundant_rows, Need::friction,      Need::jumps,
                                          Need::rotations, Need::events,         Need::error_estimate};

const char* name(Need need);  // "redundant_rows": as in the matrix
const char* noun(Need need);  // "redundant rows": as in "takes no ..."

// From the method's traits and abilities.
bool takes(const Integrator& method, Need need);

}  // namespace trammel::compatibility
