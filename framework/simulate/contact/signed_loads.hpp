// The loads of a joint's bearings that have a sign: p = C w of those in one direction (joint_friction.hpp), which press
// on one side or the other. Where one passes through 0 the friction |p| has a kink.
#pragma once

#include <vector>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

int count_signed_loads(const model::Model& model, int contact);
// [N] At the system's point, which is at t, by the joint's multipliers among lambda.
std::vector<double> signed_loads(model::AssembledSystem& system, int contact, double t, const Vec& lambda);

}  // namespace trammel::simulate
