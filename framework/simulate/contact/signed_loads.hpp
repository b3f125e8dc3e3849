// The loads of those bearings of a joint that have a sign: p = C w with one direction (joint_friction.hpp), positive or
// negative by the side that is pressed. Where p passes through 0 the friction's bound |p| has a kink.
#pragma once

#include <vector>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

int count_signed_loads(const model::Model& model, int contact);
// [N] At the system's point and time t, from the joint's part of lambda.
std::vector<double> signed_loads(model::AssembledSystem& system, int contact, double t, const Vec& lambda);

}  // namespace trammel::simulate
