// A pole of a surface: where an edge of the reference is one point, one tangent vanishes, so that no normal is defined.
// A point close to the pole has a tangent plane.
#pragma once

#include <optional>

#include "tspline_plate/shell/discretisation.hpp"

namespace trammel::plate {

// The parameter that turns about the pole, 0 u or 1 v; none: `at` is no pole.
std::optional<int> turning_at_pole(const Discretisation& mesh, const Eigen::Vector2d& at);
// `at`; if it is a pole, the point a millionth of the way from it to the middle of the patch.
Eigen::Vector2d beside_pole(const Discretisation& mesh, const Eigen::Vector2d& at);

}  // namespace trammel::plate
