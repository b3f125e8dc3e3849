// Loops whose length is known to the compiler, so that their values stay in registers.
#pragma once

#include <type_traits>

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// Calls f(n) with n as a compile-time constant. False: n is more than m, or 0.
template <int m = most_unrolled, class F>
bool with_fixed_size(Eigen::Index n, F&& f) {
  if constexpr (m > 0) {
    if (n != m) return with_fixed_size<m - 1>(n, f);
    f(std::integral_constant<Eigen::Index, m>());
  }
  return m > 0;
}

// Splits m into consecutive parts of `part` and then at most one of each of its halves (4, 2, 1), and calls
// f(number, first) with the number as a compile-time constant. The values of a part stay in registers; a loop over all
// m rows at once would keep them in memory.
template <Eigen::Index part = most_unrolled, class F>
void in_fixed_parts(Eigen::Index m, F&& f, Eigen::Index first = 0) {
  for (; first + part <= m; first += part) f(std::integral_constant<Eigen::Index, part>(), first);
  if constexpr (part > 1) in_fixed_parts<part / 2>(m, f, first);
}

template <Eigen::Index part>
using PartOfRows = Eigen::Array<double, part, 1>;
template <Eigen::Index part>
Eigen::Map<PartOfRows<part>> part_at(double* x) {
  return Eigen::Map<PartOfRows<part>>(x);
}
template <Eigen::Index part>
Eigen::Map<const PartOfRows<part>> part_at(const double* x) {
  return Eigen::Map<const PartOfRows<part>>(x);
}

}  // namespace trammel::numerics
