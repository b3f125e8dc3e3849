#include "compatibility/need.hpp"

namespace trammel::compatibility {

const char* name(Need need) {
  constexpr std::array names = {"rows", "redundant_rows", "friction", "jumps", "rotations", "events", "error_estimate"};
  return names[std::size_t(need)];
}

const char* noun(Need need) {
  constexpr std::array nouns = {"rows",
                                "redundant rows",
                                "friction that sticks",
                                "forces that jump within a step",
                                "rotations in space",
                                "events",
                                "tolerances of its error"};
  return nouns[std::size_t(need)];
}

bool takes(const Integrator& method, Need need) {
  const Traits traits = method.traits();
  switch (need) {
    case Need::rows:
      return traits.rows;
    case Need::redundant_rows:
      return traits.rows && traits.redundant_rows;
    case Need::friction:
      return traits.rows && traits.events && traits.friction;
    case Need::jumps:
      return traits.jumps;
    case Need::rotations:
      return traits.rotations;
    case Need::events:
      return traits.events;
    case Need::error_estimate:
      return dynamic_cast<const ErrorEstimate*>(&method) != nullptr;
  }
  return false;
}

}  // namespace trammel::compatibility
