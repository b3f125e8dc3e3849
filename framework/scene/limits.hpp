// Limits of a scene's size. Each is far beyond the needs of a scene; a file made to exhaust the machine is refused
// early, with a message that names its line.
#pragma once

#include <cstddef>

namespace trammel::scene::limits {

inline constexpr std::size_t bytes = 64u << 20;  // of a scene with its includes; of a table
inline constexpr int files = 1000;               // read by "include"; a file counts each time
inline constexpr int nested = 100;               // arrays and objects; includes; parameters in parameters
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // libFuzzer's name; under its sanitizers more take minutes and 10 GB
inline constexpr std::size_t values = 1'000'000;
#else
// Values of a scene after repetition; a mast of 100,000 units has 26 million. Each takes about 150 bytes.
inline constexpr std::size_t values = 30'000'000;
#endif
inline constexpr std::size_t bytes_of_a_value = 64;  // longer texts, names and paths count as more values
inline constexpr std::size_t name = 500;             // [bytes] of a key
inline constexpr std::size_t problems = 100;         // reported; reading ends at the next one
inline constexpr std::size_t message = 2000;         // [bytes] of a problem
inline constexpr std::size_t path = 300;             // [bytes] of the JSON path in a problem

}  // namespace trammel::scene::limits
