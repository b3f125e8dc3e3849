// The null spaces of the rows G and of the reactions W at the system's point. Their bases are orthonormal in units of
// the sizes of the coordinates, so they do not depend on the unit of length.
#pragma once

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct TangentSpace {
  model::CoordinateSizes sizes;
  Mat Z;                 // G Z = 0: nv x m; orthonormal in units of the sizes
  Mat left;              // W left = 0; Z itself unless sliding friction couples rows
  bool sliding = false;  // W differs from G
  int redundant = 0;     // number of redundant rows
};
TangentSpace tangent_space(model::AssembledSystem& system);  // throws model::NotSolvable

Mat rows_transposed(model::AssembledSystem& system);       // G^T
Mat reactions_transposed(model::AssembledSystem& system);  // W^T

}  // namespace trammel::simulate
