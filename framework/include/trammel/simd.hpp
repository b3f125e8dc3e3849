// Packs of four numbers, which one SIMD instruction processes (two without AVX): for inner loops whose sums a compiler
// may not reorder by itself. Arrays are padded to whole packs; what stands in the padding must not matter.
#pragma once

#include <cstddef>

namespace trammel::simd {

inline constexpr int pack = 4;  // numbers

// n, rounded up to whole packs
constexpr int padded(int n) {
  return (n + pack - 1) / pack * pack;
}
constexpr std::ptrdiff_t padded(std::ptrdiff_t n) {
  return (n + pack - 1) / pack * pack;
}

using Pack = double [[gnu::vector_size(8 * pack)]];  // stays in registers
using PackInMemory = double [[gnu::vector_size(8 * pack), gnu::aligned(8), gnu::may_alias]];

inline const PackInMemory& pack_at(const double* x) {
  return *reinterpret_cast<const PackInMemory*>(x);
}
inline PackInMemory& pack_at(double* x) {
  return *reinterpret_cast<PackInMemory*>(x);
}

// The sum of the four numbers.
inline double total(const Pack& s) {
  return (s[0] + s[2]) + (s[1] + s[3]);
}

}  // namespace trammel::simd
