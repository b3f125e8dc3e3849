// The beam of scenes/beam_impact.json with whatever a benchmark varies.
#pragma once

#include <optional>
#include <string>

#include "scene/value.hpp"

namespace trammel::bench {

struct BeamScene {
  int modes = 5;  // axial and transverse, as many of each
  std::string coupling = "full";
  std::string integrator = "hht_alpha";
  double step = 1e-6;           // [s]
  double angle = 0;             // [rad]
  double angular_velocity = 0;  // [rad/s]
  std::optional<double> plane = {};  // [m] height of a plane under the tip; none: a scene without contacts

  scene::Scene parse() const;
};

}  // namespace trammel::bench
