// A mechanism in a static problem: the body that moves most in the motion of least stiffness, where that is (almost)
// none against the stiffness of a random motion. Found by inverse iteration with K + shift M; nothing where the system
// resists every motion.
#pragma once

#include <optional>
#include <string>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// omega^2 of a random motion: that of the stiffest motion up to a small factor. At q [nq] and rest.
double stiffness_of_unrelated_motion(model::AssembledSystem& system, double t, const Vec& q);

// At q [nq] and rest: a message for the user.
std::optional<std::string> find_mechanism(model::AssembledSystem& system, double t, const Vec& q);

}  // namespace trammel::simulate
