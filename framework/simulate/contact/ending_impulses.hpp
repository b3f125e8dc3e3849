// The least impulses that end rates along directions of contacts at rest: A P = -rates, A their Delassus matrix.
#pragma once

#include <trammel/types.hpp>

namespace trammel::simulate {

// [N s] Rates that contradict each other by their drift, in rows that nearly depend on each other, are not all ended:
// the impulses of the others are 0.
Vec ending_impulses(const Mat& A, const Vec& rates);

}  // namespace trammel::simulate
