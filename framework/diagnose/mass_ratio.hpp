// Light bodies connected to heavy ones by rows. The force on the heavy one, lambda, has a round-off of eps lambda, so
// the acceleration of the light one has an error of eps lambda / m_light, which is a large part of it if the ratio
// exceeds 1e7. Error estimates of explicit methods then enforce very short steps, unless they measure motions along the
// rows only (`rows: projected`).
#pragma once

#include <string>

#include <trammel/integrator.hpp>

#include "model/model.hpp"

namespace trammel::simulate {

// The largest ratio among bodies that joints connect, directly or through others; only bodies with HasMomentum count.
struct MassRatio {
  int light = -1, heavy = -1;             // bodies; -1: there is none
  double light_mass = 0, heavy_mass = 0;  // [kg]
  bool is_large() const { return heavy_mass > 1e7 * light_mass; }
};
MassRatio mass_ratio(const model::Model& model, const State& state);

// "bodies.u of 1 kg is tied to bodies.l of 1e+12 kg, a mass ratio of 1e+12"
std::string description(const MassRatio& ratio, const model::Model& model);

}  // namespace trammel::simulate
