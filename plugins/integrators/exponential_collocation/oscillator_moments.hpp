// The response of an oscillator omega to a force u^k, with u from 0 to 1 in a time T, at the end of this time. With z =
// omega T
//
//     c_k = int_0^1 cos(z (1 - u)) u^k du          velocity T c_k
//     s_k = int_0^1 sin(z (1 - u))/z u^k du        position T^2 s_k       (z = 0: 1/(k + 1) and 1/((k + 1)(k + 2)))
//
// By parts: c_0 = sin(z)/z, c_k = k s_{k-1}; z^2 s_0 = 1 - cos(z), z^2 s_k = 1 - k c_{k-1}. These are the phi functions
// of exponential integrators for the matrix [0 1; -omega^2 0] (Hochbruck, Ostermann, Acta Numerica 19 (2010), section
// 2).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace trammel {

template <int n>
struct OscillatorMoments {
  std::array<double, n> c, s;
  double cosine, sine;  // cos(z), sin(z)/z
};

// s_k by its series sum_j (-z^2)^j k!/(k + 2 j + 2)!, to round-off for z below 2.
template <int k>
double oscillator_series(double z_2) {
  constexpr int terms = 11;
  static constexpr auto ratios = [] {
    std::array<double, terms> r{};
    for (int j = 0; j < terms; ++j) r[std::size_t(j)] = 1.0 / ((k + 2 * j + 1) * (k + 2 * j + 2));
    return r;
  }();
  double sum = 1;
  for (int j = terms - 1; j > 0; --j) sum = 1 - z_2 * ratios[std::size_t(j)] * sum;
  return ratios[0] * sum;
}

template <int n>
OscillatorMoments<n> oscillator_moments(double z) {
  static_assert(n >= 2);
  constexpr double cancels = 2;  // below this, z^2 s_k = 1 - ... suffers from cancellation
  OscillatorMoments<n> m;
  auto& [c, s, cosine, sine] = m;
  const double z_2 = z * z;
  cosine = std::cos(z);
  sine = z > 0 ? std::sin(z) / z : 1;
  if (z < cancels) {
    s[n - 1] = oscillator_series<n - 1>(z_2);
    s[n - 2] = oscillator_series<n - 2>(z_2);
    for (std::size_t k = n - 1; k >= 2; --k) s[k - 2] = (1 - z_2 * s[k]) / double(k * (k - 1));
  } else {
    const double of_z_2 = 1 / z_2;
    s[0] = (1 - cosine) * of_z_2;
    s[1] = (1 - sine) * of_z_2;
    for (std::size_t k = 2; k < n; ++k) s[k] = (1 - double(k * (k - 1)) * s[k - 2]) * of_z_2;
  }
  c[0] = sine;
  for (std::size_t k = 1; k < n; ++k) c[k] = double(k) * s[k - 1];
  return m;
}

}  // namespace trammel
