// The unit of round-off of doubles, relative.
#pragma once

#include <limits>

namespace trammel {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace trammel
