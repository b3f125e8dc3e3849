// The changes made by a refinement, as written to events.csv.
#pragma once

#include <optional>
#include <string>

#include <trammel/body.hpp>

namespace trammel::simulate {

struct RefineEvent {
  struct Side {
    Sizes sizes;  // of the body: nq, nv
    Energy energy;
    std::optional<Momentum> momentum;  // of bodies with HasMomentum
  };
  double t = 0;
  int body = 0;
  std::string cause;  // "contacts.NAME", or "step"
  Side before, after;
};

}  // namespace trammel::simulate
