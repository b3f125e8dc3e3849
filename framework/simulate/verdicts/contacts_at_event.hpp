// What the rules of one event tell each other about its contacts.
#pragma once

#include <optional>
#include <vector>

#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

struct ContactsAtEvent {
  model::Modes before;              // the modes until now, in which latches have locked that lock at this event
  std::vector<bool> shared_before;  // by contact: it depended on rows of others
  std::vector<std::optional<double>> pressed;  // [N] by contact: settling/pressed_until_now; empty if nothing is known
  std::vector<TouchingContact> touching, bearings;  // contacts; joints that rub: what impacts have done to them
  model::Modes modes;                               // from now on, as far as they are decided
  // [m/s^2] By contact: the largest acceleration in its island without the forces sought, in the last problem.
  std::vector<double> largest;

  std::optional<double> pressed_until_now(int contact) const {
    return pressed.empty() ? std::nullopt : pressed[std::size_t(contact)];
  }
};

}  // namespace trammel::simulate
