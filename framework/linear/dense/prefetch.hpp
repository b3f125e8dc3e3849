// Prefetching for loops over many bodies whose numbers are scattered in memory: an access to memory takes longer than
// the work on the data. Timings: tools/bench/README.md.
#pragma once

#include <algorithm>
#include <cstddef>

namespace trammel::numerics {

// Prefetches for reading or writing. (The empty asm statement keeps GCC from removing calls as having no effect.)
inline void prefetch(const void* place, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < bytes; at += line) __builtin_prefetch(static_cast<const char*>(place) + at);
  asm volatile("");
}

// The same for loops that run backwards: the processor fetches contiguous descending lines as fast as ascending ones,
// others at half the speed.
inline void prefetch_down(const void* place, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t left = bytes; left > 0; left -= std::min(line, left))
    __builtin_prefetch(static_cast<const char*>(place) + left - 1);
  asm volatile("");
}

// In step i of n: calls f(i + 4), the prefetch distance, if that is less than n.
template <class F>
void look_ahead(std::size_t i, std::size_t n, F&& f) {
  constexpr std::size_t ahead = 4;
  if (i + ahead < n) f(i + ahead);
}

}  // namespace trammel::numerics
