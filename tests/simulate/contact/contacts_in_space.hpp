// The contacts of tests of friction in space, and steps that resolve them.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "support/run_scene.hpp"

namespace trammel::test {

using std::numbers::pi;

inline constexpr double g = 9.81;
inline const std::string rigid = R"("type": "constraint_method")";
inline const std::string compliant = R"("type": "continuous_force", "stiffness": 1e6, "damping": "none")";
// Forces of the compliant contact are off by its stiffness there, 3e4 N/m, times what positions may be off.
inline const std::string accurate = R"({"type": "dop853", "step": {"tolerance": 1e-14}})";

// Where a compliant contact carries N [N] per foot.
inline double sunk(const std::string& law, double N) {
  return law == compliant ? -std::pow(N / 1e6, 1 / 1.5) : 0;
}

}  // namespace trammel::test
