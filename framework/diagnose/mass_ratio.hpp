// Light bodies that rows tie to heavy ones. A force that holds the heavy one, lambda, is known to round-off only, so the light one's
// acceleration is to eps lambda / m_light: a large part of it where the ratio is beyond 1e7. Error estimates of explicit methods see
// that as an error and take steps so short that it does not count, unless they look at motions along the rows alone (`rows: projected`).
#pragma once

#include <string>

#include <trammel/integrator.hpp>

#include "model/model.hpp"

namespace trammel::simulate {

// The largest ratio among bodies that joints tie, directly or by others, of those that know their mass.
struct MassRatio {
  int light = -1, heavy = -1;             // bodies; -1: there is none
  double light_mass = 0, heavy_mass = 0;  // [kg]
  bool is_large() const { return heavy_mass > 1e7 * light_mass; }
};
MassRatio mass_ratio(const model::Model& model, const State& state);

// "bodies.u of 1 kg is tied to bodies.l of 1e+12 kg, a mass ratio of 1e+12"
std::string description(const MassRatio& ratio, const model::Model& model);

}  // namespace trammel::simulate
