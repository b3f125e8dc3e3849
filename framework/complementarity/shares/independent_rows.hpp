// Q^T E: as many combinations of the rows of E as are independent, up to what makes rows dependent (row_basis.hpp). Its
// null space is that of E.
#pragma once

#include <trammel/types.hpp>

namespace trammel::complementarity {

Mat independent_rows(const Mat& E);

}  // namespace trammel::complementarity
