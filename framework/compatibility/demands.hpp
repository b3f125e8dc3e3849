// What a scene's bodies, joints and contacts need of the integrator.
#pragma once

#include <string>
#include <vector>

#include "compatibility/need.hpp"
#include "model/model.hpp"

namespace trammel::compatibility {

struct Demand {
  Need need;
  std::string cause;  // "joints.pin has rows"
};

// The first component with each need. Rows are redundant at states, not in models: see integrator_check.hpp.
std::vector<Demand> demands(const model::Model& model);

}  // namespace trammel::compatibility
