// Packs of four numbers, which one SIMD instruction processes (two without AVX): for inner loops whose sums a compiler
// may not reorder by itself. Arrays are padded to whole packs: with 0 where packs are summed, with anything finite
// elsewhere. Functions that are not inline take packs by reference: by value, their calling convention depends on AVX.
#pragma once

#include <concepts>

namespace trammel::simd {

inline constexpr int pack = 4;  // numbers

// n, rounded up to whole packs
template <std::integral Integer>
constexpr Integer padded(Integer n) {
  return (n + pack - 1) / pack * pack;
}

// In this form, and not as [[gnu::vector_size]], Clang takes the attributes, too.
typedef double Pack __attribute__((vector_size(8 * pack)));
typedef double PackInMemory __attribute__((vector_size(8 * pack), aligned(8), may_alias));

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
