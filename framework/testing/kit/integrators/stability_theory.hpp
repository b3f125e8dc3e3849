// The spectral radius of a method on x'' = -omega^2 x by theory, where the method is one of those whose amplification
// matrix is written down in the literature.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "testing/kit/subject.hpp"

namespace trammel::kit {

struct StabilityTheory {
  std::function<double(double Omega)> radius;  // Omega = omega h
  std::string source;
};
// By the component's parameters: beta and gamma (Newmark), alpha (HHT-alpha), rho_inf (generalised alpha); explicit
// Runge-Kutta methods of order p <= 4 with p stages, by their order.
std::optional<StabilityTheory> stability_theory(const Subject& s);

}  // namespace trammel::kit
