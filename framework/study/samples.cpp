#include "study/samples.hpp"

#include <cmath>
#include <random>

#include <boost/random/sobol.hpp>

namespace trammel::study {
namespace {

// A number of 53 bits in [0, 1). (std::uniform_real_distribution differs between libraries.)
double uniform(std::mt19937_64& generator) {
  return double(generator() >> 11) * 0x1p-53;
}

}  // namespace

double Range::at(double share) const {
  if (share <= 0) return from;
  if (share >= 1) return to;
  return logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
}

std::vector<std::vector<std::size_t>> grid(const std::vector<std::size_t>& lengths) {
  std::vector<std::vector<std::size_t>> all = {{}};
  for (const std::size_t length : lengths) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& tuple : all)
      for (std::size_t i = 0; i < length; ++i) longer.push_back(tuple), longer.back().push_back(i);
    all = std::move(longer);
  }
  return all;
}

std::vector<std::vector<double>> random_points(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (auto& point : points)
    for (double& x : point) x = uniform(generator);
  return points;
}

std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t dimensions,
                                              std::optional<std::uint64_t> seed) {
  boost::random::sobol sequence(dimensions);
  std::vector<double> shift(dimensions, 0.0);
  if (seed) {
    std::mt19937_64 generator(*seed);
    for (double& s : shift) s = uniform(generator);
  }
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (auto& point : points)
    for (std::size_t k = 0; k < dimensions; ++k) {
      const double x = double(sequence() >> 11) * 0x1p-53 + shift[k];
      point[k] = x - std::floor(x);
    }
  return points;
}

}  // namespace trammel::study
