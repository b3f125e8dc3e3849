// How much a scene may ask for. Each limit is far beyond what a scene needs; a file made to exhaust the machine meets it early,
// with a message that names its line.
#pragma once

#include <cstddef>

namespace trammel::scene::limits {

inline constexpr std::size_t bytes = 64u << 20;   // of a scene with all it includes; of a table
inline constexpr int files = 1000;                // read by include, a file as often as it is named
inline constexpr int nested = 100;                // arrays and objects; includes by includes; parameters by one another
inline constexpr std::size_t values = 30'000'000;  // of the whole scene after repetition: a mast of 100,000 units has 26 million
inline constexpr std::size_t bytes_of_a_value = 64;  // longer texts, names and paths count as more values
inline constexpr std::size_t name = 500;             // [bytes] of a key
inline constexpr std::size_t problems = 100;         // reported; the next one ends the reading
inline constexpr std::size_t message = 2000;         // [bytes] of a problem
inline constexpr std::size_t path = 300;             // [bytes] of the place that it names

}  // namespace trammel::scene::limits
