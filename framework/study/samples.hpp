// The points of a study: all combinations, pairs, pseudo-random or quasi-random ones.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace trammel::study {

struct Range {
  double from = 0, to = 1;
  bool logarithmic = false;       // evenly in log x; from and to > 0
  double at(double share) const;  // share in [0, 1]; the ends exactly
};

// Index tuples of a grid of these lengths; the last index runs fastest.
std::vector<std::vector<std::size_t>> grid(const std::vector<std::size_t>& lengths);

// `count` points in the unit cube.
std::vector<std::vector<double>> random_points(std::size_t count, std::size_t dimensions, std::uint64_t seed);
// Sobol's sequence from its second point on (the first is a corner), shifted modulo 1 if there is a seed.
std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t dimensions,
                                              std::optional<std::uint64_t> seed);

}  // namespace trammel::study
