// Where a mode moves the points of the bodies, for plots: real and imaginary part of d(x)/d(amplitude).
#pragma once

#include <string>

#include "modes/normal_modes.hpp"

namespace trammel::simulate {

// CSV: mode, point ("beam.tip", a marker; "beam:3", of the body's outline), x, y(, z) at the state, and the
// displacements x_re, x_im, ... for the mode's largest coordinate at 1. Markers and outlines of all bodies.
std::string shapes_csv(model::AssembledSystem& system, const State& state, const std::vector<Mode>& modes);

}  // namespace trammel::simulate
