#include "beam_scene.hpp"

#include <fmt/format.h>

namespace trammel::bench {

scene::Scene BeamScene::parse() const {
  const std::string contacts = !plane ? ""
                                      : fmt::format(R"(
    "contacts": {{"tip": {{"type": "constraint_method", "restitution": 0,
      "between": ["beam.tip", {{"plane": {{"point": [0, {}], "normal": [0, 1]}}}}]}}}},)",
                                                    *plane);
  const std::string text = fmt::format(R"({{
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {{"beam": {{
      "type": "assumed_mode_beam",
      "length": 1.0, "area": 3.14e-4, "second_moment": 7.85e-9, "density": 2766.7, "youngs_modulus": 6.8952e10,
      "modes": {{"axial": {0}, "transverse": {0}}}, "coupling": "{1}",
      "mount": {{"hinge": [0, 0]}}, "angle": {2}, "angular_velocity": {3}
    }}}},{4}
    "integrator": {{"type": "{5}"{6}, "step": {7}}},
    "simulate": {{"until": 1e6}},
    "record": {{"every": 1e-3, "observe": {{"theta": "beam.angle", "tip_y": "beam.tip.y"}}}}
  }})",
                                       modes, coupling, angle, angular_velocity, contacts, integrator,
                                       integrator == "hht_alpha" ? R"(, "alpha": -0.15)" : "", step);
  return scene::Scene::parse(text, "benchmark.json");
}

}  // namespace trammel::bench
