// Loops over few rows whose number is known to the compiler, so that their values stay in registers.
#pragma once

#include <type_traits>

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// Calls f with the number of rows as a compile-time constant. False: there are more than `few`, or none.
template <int m = few, class F>
bool with_few(Eigen::Index rows, F&& f) {
  if constexpr (m > 0) {
    if (rows != m) return with_few<m - 1>(rows, f);
    f(std::integral_constant<Eigen::Index, m>());
  }
  return m > 0;
}

// Splits m into consecutive parts, eights and then at most one of 4, 2 and 1, and calls f(number, first) with the
// number as a compile-time constant. The values of a part stay in registers; a loop over all m rows at once would keep
// them in memory.
template <Eigen::Index part = few, class F>
void in_parts(Eigen::Index m, F&& f, Eigen::Index first = 0) {
  for (; first + part <= m; first += part) f(std::integral_constant<Eigen::Index, part>(), first);
  if constexpr (part > 1) in_parts<part / 2>(m, f, first);
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
