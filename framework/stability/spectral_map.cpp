#include "stability/spectral_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trammel::stability {

namespace {

std::complex<double> exact_factor(double Omega, double zeta) {
  const std::complex<double> z = Omega * (-zeta + std::sqrt(std::complex<double>(zeta * zeta - 1)));
  return std::exp(z);
}

// The root with the argument of the forward motion: roots come in conjugate pairs. If some pair oscillates, real roots
// are the method's own: the exact factor turns many times with Omega and passes near any of them.
std::complex<double> principal(std::vector<std::complex<double>> roots, std::complex<double> exact) {
  constexpr double round_off = 1e-12;
  const auto real = [](std::complex<double> root) { return std::abs(root.imag()) <= round_off * std::abs(root); };
  if (!std::all_of(roots.begin(), roots.end(), real)) std::erase_if(roots, real);
  const auto distance = [&](std::complex<double> root) {
    return std::min(std::abs(root - exact), std::abs(std::conj(root) - exact));
  };
  const auto nearest =
      std::min_element(roots.begin(), roots.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
  return {nearest->real(), std::abs(nearest->imag())};
}

}  // namespace

Oscillation oscillation(const std::vector<std::complex<double>>& roots, double Omega, double zeta) {
  if (roots.empty()) return {};
  Oscillation o;
  for (const std::complex<double> root : roots) o.radius = std::max(o.radius, std::abs(root));
  const std::complex<double> z = std::log(principal(roots, exact_factor(Omega, zeta)));
  o.damping = -z.real() / std::abs(z);
  const double exact = Omega * std::sqrt(std::max(0.0, 1 - zeta * zeta));
  o.period_error = exact / std::abs(z.imag()) - 1;
  return o;
}

std::vector<MapPoint> spectral_map(const Maker& method, const LinearTheory* theory, double zeta,
                                   std::span<const double> Omegas) {
  std::vector<MapPoint> map;
  for (const double Omega : Omegas) {
    MapPoint point{.Omega = Omega, .measured = {}, .theory = {}};
    try {
      point.measured = oscillation(amplification(method, Omega, zeta).roots, Omega, zeta);
    } catch (const std::runtime_error&) {  // integrate: a step was rejected
    }
    if (theory) point.theory = oscillation(theory->roots(Omega, zeta), Omega, zeta);
    map.push_back(point);
  }
  return map;
}

std::vector<double> logarithmic(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first * std::pow(last / first, double(i) / (count - 1)));
  return values;
}

}  // namespace trammel::stability
