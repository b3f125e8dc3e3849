// What the normal of a contact at rest does, seen as a spring (complementarity/shares/springs_at_rest.hpp).
#pragma once

#include <optional>
#include <vector>

namespace trammel::complementarity {

enum class Spring {
  undecided,  // it may press or part: force and slack may both be positive
  presses,    // it has a force, or 0
  parts,      // the push of the others would part it, or leaves it where it is
  touches,    // neither: the limit of both
  locked      // no springs hold its group, which rests by other forces
};
using SpringSet = std::vector<Spring>;  // by contact

// Which springs hold, and where contacts can be wedged in, how far they are pushed (complementarity/spring_motion.hpp).
struct SpringsThatHold {
  SpringSet set;
  std::vector<std::optional<double>> push;  // [N] by contact
};

}  // namespace trammel::complementarity
