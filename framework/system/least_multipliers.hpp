// Multipliers of redundant rows as they are recorded.
#pragma once

#include "system/assembled_system.hpp"

namespace trammel::model {

// Replaces lambda, from the last `accelerate` at the system's point, by the one of least norm with the same forces G^T
// lambda, with rows in the units in which joints write them. Steps do not need this. With bodies in blocks it costs ten
// times as much as the accelerations; other storages have computed it already. If something slides under its reactions
// (W is not G), lambda stays: the motion may depend on it.
void minimise_norm(AssembledSystem& system, Vec& lambda);

}  // namespace trammel::model
