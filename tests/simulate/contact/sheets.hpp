// Scenes of sheets that lie on a plane or on each other: 20 mm thick, 1000 kg/m^3, so 200 Pa each at 10 m/s^2.
#pragma once

#include <string>

#include <fmt/format.h>

namespace trammel::test {

// A free sheet of 1 m x 0.8 m with a corner there; `more` begins with a comma.
inline std::string sheet(const std::string& origin, const std::string& more = "", const std::string& elements = "3x3") {
  return R"({"type": "tspline_plate", "geometry": {"shape": "rectangle", "origin": )" + origin +
         R"(, "along_u": [1, 0, 0], "along_v": [0, 0.8, 0]}, "mesh": {"elements": ")" + elements +
         R"("}, "thickness": 0.02, "density": 1000,
      "youngs_modulus": 1e8, "poissons_ratio": 0.3)" +
         more + "}";
}

inline std::string sheets(const std::string& bodies, const std::string& contacts, const std::string& observe,
                          double until, const std::string& gravity = "[0, 0, -10]") {
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": {}, "bodies": {{{}}}, "contacts": {{{}}},
    "integrator": {{"type": "generalized_alpha", "rho_inf": 1, "step": 1e-3}}, "simulate": {{"until": {}}},
    "static": {{"steps": 1}}, "record": {{"every": 0.01, "observe": {{{}}}}}}})",
                     gravity, bodies, contacts, until, observe);
}

const std::string on_floor =
    R"("type": "penalty", "stiffness": 1e7, "between": [{"surface": "sheet"}, {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}])";

}  // namespace trammel::test
