// How the matrices of a system are stored.
#pragma once

#include "model/model.hpp"

namespace trammel::model {

// Dense matrices; sparse M and S with dense rows, for bodies with many coordinates; or blocks by bodies with sparse
// factorisations, for many bodies coupled by rows. automatic: the one that was measured to be fastest (storage_for).
enum class Storage { automatic, dense, sparse, blocks };
Storage storage_for(const Model& model);

}  // namespace trammel::model
