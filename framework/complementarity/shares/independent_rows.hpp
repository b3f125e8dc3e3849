// Q^T E: a largest set of independent combinations of the rows of E, up to the tolerance of row_basis.hpp. It has the
// same null space as E.
#pragma once

#include <trammel/types.hpp>

namespace trammel::complementarity {

Mat independent_rows(const Mat& E);

}  // namespace trammel::complementarity
