// Groups of closed contacts whose rows depend on each other (model::SharedRows).
#pragma once

#include <vector>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

inline bool has_sliding(const model::SharedRows& group) {
  return !group.sliding.empty();
}
std::size_t implied_rows(const model::Modes& modes);  // that follow from others, and have no multiplier of their own
bool shares_tangents(const model::SharedRows& group, int contact);
// Contacts that are not `asked`, and the groups in which they share, get the modes that were decided before. A group of
// either modes is asked as a whole, so that none names rows that its contacts do not have.
void keep_others(const model::Modes& decided, std::vector<bool> asked, model::Modes& modes);

// Takes the springs found for a group; false if none hold.
[[nodiscard]] bool take_springs(const std::vector<model::ContactSpring>& found, model::Modes& modes);

}  // namespace trammel::simulate
