// Forces that hold contacts at rest where their slip ends: a = A F + b = 0 along all normals and all tangents that
// friction can hold.
//
// A body that is wedged in may then come to rest or slide back under the same loads. On stiff springs it rests, as far
// as springs hold it that are pushed as they were while it slid (spring_motion.hpp), for the resultants lambda of the
// rows (shares/row_basis.hpp)
//
//     A_bb lambda = -b_b  (b: a basis of the rows),    E F = lambda
#pragma once

#include <optional>
#include <vector>

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

// In the order of b; none if springs do not hold them, if a contact slides, or if none can be wedged in. N [N]: until
// now, in the same order; NaN if one is unknown.
std::optional<Vec> forces_at_rest(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& N);

}  // namespace trammel::complementarity
