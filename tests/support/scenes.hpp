// Small scenes whose motion is known; tests change single values of them.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace trammel::test {

// Falls 1 m under g = 10 m/s^2: first impact at sqrt(0.2) s with sqrt(20) m/s.
inline const std::string ball = R"({
  "trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {"ball": {"type": "point_mass", "mass": 0.1, "position": [0, 1], "velocity": [0.5, 0]}},
  "contacts": {"floor": {"type": "constraint_method", "restitution": 0.5,
                         "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-3},
  "simulate": {"until": 2},
  "record": {"every": 0.01, "observe": {"x": "ball.point.x", "y": "ball.point.y", "force": "contacts.floor.force",
                                        "closed": "contacts.floor.closed"}}
})";

// x = y - 1 = cos t until it strikes y = 1; then each flight takes half a period, pi, whatever the speed.
inline const std::string oscillator = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"mass": {"type": "point_mass", "mass": 1, "position": [0, 2]}},
  "forces": {"spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 1, "length": 1}},
  "contacts": {"wall": {"type": "constraint_method", "restitution": 0.5,
                        "between": ["mass.point", {"plane": {"point": [0, 1], "normal": [0, 1]}}]}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-2},
  "simulate": {"until": 10},
  "record": {"every": 0.1, "observe": {"y": "mass.point.y"}}
})";

// A bar on a hinge strikes a plane, stays, and is lifted off again by a load, with a damper: rows of a joint, impacts,
// closed phases, all causes of energy.
inline const std::string struck_bar = R"json({
  "trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {"bar": {"type": "rigid_body", "mass": 1, "inertia": "=1/12", "position": [0.4, 0.3], "angle": "=atan(0.75)",
                     "markers": {"hinge": [-0.5, 0], "tip": [0.5, 0]}}},
  "joints": {"hinge": {"type": "revolute", "between": ["ground", "bar.hinge"]}},
  "forces": {"damper": {"type": "torsional_spring", "between": ["ground", "bar.hinge"], "stiffness": 0.5, "damping": 0.1},
             "lift": {"type": "load", "on": "bar.tip", "force": {"x": 0, "y": "=8*sin(12*t)"}}},
  "contacts": {"tip": {"type": "constraint_method", "restitution": 0.2,
                       "between": ["bar.tip", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-3},
  "simulate": {"until": 1.5},
  "record": {"every": 0.01, "observe": {"tip": "bar.tip.y", "closed": "contacts.tip.closed"}}
})json";

// Every integrator, with fixed steps and, where it can, with error control.
struct Method {
  std::string name;
  std::string json;
};
inline std::vector<Method> fixed_methods(const std::string& h) {
  std::vector<Method> methods;
  for (const char* type : {"hht_alpha", "newmark", "generalized_alpha", "adams_baumgarte", "runge_kutta_4",
                           "dormand_prince", "dop853", "exponential_collocation"})
    methods.push_back({type, "{\"type\": \"" + std::string(type) + "\", \"step\": " + h + "}"});
  return methods;
}
inline std::vector<Method> controlled_methods(const std::string& tolerance) {
  std::vector<Method> methods;
  for (const char* type : {"hht_alpha", "dormand_prince", "dop853", "exponential_collocation"})
    methods.push_back({std::string(type) + "_controlled",
                       "{\"type\": \"" + std::string(type) + "\", \"step\": {\"tolerance\": " + tolerance + "}}"});
  return methods;
}
inline std::string method_name(const testing::TestParamInfo<Method>& method) {
  return method.param.name;
}
inline void PrintTo(const Method& method, std::ostream* out) {
  *out << method.name;
}

}  // namespace trammel::test
