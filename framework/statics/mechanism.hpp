// A mechanism in a static problem: the body that moves most in the motion of least stiffness, if that stiffness is
// (almost) zero relative to that of a pseudo-random motion. Found by inverse iteration with K + shift M; empty if the
// system resists every motion.
#pragma once

#include <optional>
#include <string>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// omega^2 of a pseudo-random motion: that of the stiffest motion up to a small factor. At rest at q [nq].
double stiffness_of_unrelated_motion(model::AssembledSystem& system, double t, const Vec& q);

// At rest at q [nq]: a message for the user.
std::optional<std::string> find_mechanism(model::AssembledSystem& system, double t, const Vec& q);

}  // namespace trammel::simulate
