// A mechanism in a static problem: the body that moves most in the motion of least stiffness, if that stiffness is
// (almost) zero relative to that of a pseudo-random motion. Inverse iteration with K + shift M finds the motion.
#pragma once

#include <optional>
#include <string>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// omega^2 [1/s^2] of a pseudo-random motion from rest at q (nq): that of the stiffest motion up to a small factor.
double stiffness_of_random_motion(model::AssembledSystem& system, double t, const Vec& q);

// At rest at q (nq): a message for the user that names the body; empty if the system resists every motion.
std::optional<std::string> find_mechanism(model::AssembledSystem& system, double t, const Vec& q);

}  // namespace trammel::simulate
