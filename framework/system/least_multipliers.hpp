// The multipliers of redundant rows that are recorded.
#pragma once

#include "system/assembled_system.hpp"

namespace trammel::model {

// lambda, that of the last `accelerate` at the system's point, becomes the one of least norm with the same forces
// G^T lambda, rows in the units in which joints write them. A step needs none of it: that costs ten times as much as
// the accelerations where bodies are in blocks; other storages have them already. Where something slides by its
// reactions (W is not G), lambda stays: the motion may depend on it.
void minimise_norm(AssembledSystem& system, Vec& lambda);

}  // namespace trammel::model
