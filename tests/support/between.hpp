// Random parameters of scenes.
#pragma once

#include <random>

namespace trammel::test {

inline double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace trammel::test
