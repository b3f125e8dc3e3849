// Roots of methods on an oscillator, in closed form.
#include <trammel/methods/linear_roots.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <gtest/gtest.h>

namespace trammel {
namespace {

using Complex = std::complex<double>;

// In the order of their imaginary, then of their real parts.
Roots sorted(Roots roots) {
  std::sort(roots.begin(), roots.end(), [](const Complex& x, const Complex& y) {
    return std::abs(x.imag() - y.imag()) > 1e-9 ? x.imag() < y.imag() : x.real() < y.real();
  });
  return roots;
}

void expect_roots(const Roots& found, const Roots& expected, double digits) {
  const Roots a = sorted(found), b = sorted(expected);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LE(std::abs(a[i] - b[i]), digits) << a[i] << " " << b[i];
}

TEST(LinearRoots, OfAnOscillatorAreItsEigenvalues) {
  const auto undamped = oscillator_eigenvalues(3, 0), damped = oscillator_eigenvalues(5, 0.6);
  EXPECT_LE(std::abs(undamped[0] - Complex(0, 3)) + std::abs(undamped[1] - Complex(0, -3)), 1e-15);
  EXPECT_LE(std::abs(damped[0] - Complex(-3, 4)) + std::abs(damped[1] - Complex(-3, -4)), 1e-14);
  const auto overdamped = oscillator_eigenvalues(4, 1.25);  // -5 +- 3
  EXPECT_LE(std::abs(overdamped[0] - Complex(-2, 0)) + std::abs(overdamped[1] - Complex(-8, 0)), 1e-14);
}

// 1 + z + z^2/2 + ... of a method with as many stages as its order.
TEST(LinearRoots, OfTheClassicalMethodAreTheExponentialSeries) {
  constexpr double c[] = {0, 0.5, 0.5, 1}, a[] = {0.5, 0, 0.5, 0, 0, 1}, b[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  const Tableau classical{4, c, a, b};
  const auto series = [](const Complex& z) { return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))); };
  for (const Complex& z : {Complex(0.3, -2), Complex(-2, 0.1), Complex(0, 1)})
    EXPECT_LE(std::abs(stability_function(classical, z) - series(z)), 1e-15);
  expect_roots(runge_kutta_roots(classical, 5, 0.6), {series({-3, 4}), series({-3, -4})}, 1e-13);
}

TEST(LinearRoots, OfAPolynomialAreThoseItIsMadeOf) {
  // (x - 1)(x - 2)(x + 4) = x^3 + x^2 - 10 x + 8
  expect_roots(polynomial_roots(Eigen::Vector3cd(-1, 10, -8)), {1, 2, -4}, 1e-13);
  // (x - i)(x - 2 i) = x^2 - 3 i x - 2
  expect_roots(polynomial_roots(Eigen::Vector2cd(Complex(0, 3), 2)), {Complex(0, 1), Complex(0, 2)}, 1e-13);
}

// (1 + z/2)/(1 - z/2); the third root is that of an acceleration that does not fit to the state.
TEST(LinearRoots, OfTheTrapezoidalRuleAreItsQuotient) {
  for (const auto& [Omega, zeta] : {std::pair(0.5, 0.0), std::pair(3.0, 0.2), std::pair(40.0, 0.0)}) {
    const Roots found = alpha_roots({.alpha_m = 0, .alpha_f = 0, .beta = 0.25, .gamma = 0.5}, Omega, zeta);
    ASSERT_EQ(found.size(), 3u);
    for (const Complex& z : oscillator_eigenvalues(Omega, zeta)) {
      const Complex expected = (1.0 + z / 2.0) / (1.0 - z / 2.0);
      EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                              [&](const Complex& root) { return std::abs(root - expected) < 1e-12; }))
          << Omega << " " << zeta;
    }
  }
}

}  // namespace
}  // namespace trammel
