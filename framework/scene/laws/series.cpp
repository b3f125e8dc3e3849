#include "scene/laws/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trammel::scene {
namespace {

constexpr double largest_whole_power = 16;  // by products; larger ones by the general recurrence

Series same_kind(const Series& u) {
  Series y;
  y.n = u.n, y.smooth = u.smooth;
  return y;
}
Series same_kind(const Series& a, const Series& b) {
  Series y;
  y.n = a.n, y.smooth = std::min(a.smooth, b.smooth);
  return y;
}

// sum over j = 1..k of j u_j w_(k-j): k times the coefficient k of y, where y' = w u'.
Range integral(const Series& u, const Series& w, int k) {
  Range sum;
  for (int j = 1; j <= k; ++j) sum += double(j) * u.c[std::size_t(j)] * w.c[std::size_t(k - j)];
  return sum;
}

// y with y(t_0) = `value` and y' = w u'.
Series primitive(const Range& value, const Series& u, const Series& w) {
  Series y = same_kind(u, w);
  y.c[0] = value;
  for (int k = 1; k <= u.n; ++k) y.c[std::size_t(k)] = (1.0 / k) * integral(u, w, k);
  return y;
}

// A pair with y' = w u' and w' = sign y u': sin and cos, sinh and cosh.
struct Pair {
  Series y, w;
};
Pair pair(const Range& y, const Range& w, const Series& u, double sign) {
  Pair both{same_kind(u), same_kind(u)};
  both.y.c[0] = y, both.w.c[0] = w;
  for (int k = 1; k <= u.n; ++k) {
    both.y.c[std::size_t(k)] = (1.0 / k) * integral(u, both.w, k);
    both.w.c[std::size_t(k)] = (sign / k) * integral(u, both.y, k);
  }
  return both;
}

// y with y' = (1 + sign y^2) u': tan and tanh.
Series by_own_square(const Range& value, const Series& u, double sign) {
  Series y = same_kind(u), w = same_kind(u);
  y.c[0] = value;
  w.c[0] = 1.0 + sign * square(value);
  for (int k = 1; k <= u.n; ++k) {
    y.c[std::size_t(k)] = (1.0 / k) * integral(u, w, k);
    for (int j = 0; j <= k; ++j) w.c[std::size_t(k)] += sign * (y.c[std::size_t(j)] * y.c[std::size_t(k - j)]);
  }
  return y;
}

// Of a function that is not defined for all of the arguments. Laws may use it: max(0, log(t)) is 0 where log(t) is not
// a number.
Series unknown(int n) {
  Series y;
  y.n = n, y.smooth = 0;
  y.c.fill(Range::empty());
  return y;
}

Range power_of_range(const Range& u, double p) {
  if (p == std::floor(p) && std::abs(p) < std::numeric_limits<int>::max()) return pow(u, int(p));
  if (p < 0) return 1.0 / power_of_range(u, -p);
  return {std::pow(std::max(u.lower(), 0.0), p), std::pow(std::max(u.upper(), 0.0), p)};
}

}  // namespace

Range Series::derivative(int k) const {
  double factorial = 1;
  for (int i = 2; i <= k; ++i) factorial *= i;
  return factorial * c[std::size_t(k)];
}

bool Series::is_constant() const {
  return std::all_of(c.begin() + 1, c.begin() + n + 1, is_zero);
}

Series constant(const Range& value, int n) {
  Series y;
  y.n = n;
  y.c[0] = value;
  return y;
}

Series variable(const Range& t, int n) {
  Series y = constant(t, n);
  y.c[1] = 1;
  return y;
}

Series operator+(const Series& a, const Series& b) {
  Series y = same_kind(a, b);
  for (std::size_t k = 0; k <= std::size_t(a.n); ++k) y.c[k] = a.c[k] + b.c[k];
  return y;
}

Series operator-(const Series& a, const Series& b) {
  Series y = same_kind(a, b);
  for (std::size_t k = 0; k <= std::size_t(a.n); ++k) y.c[k] = a.c[k] - b.c[k];
  return y;
}

Series operator-(const Series& u) {
  Series y = same_kind(u);
  for (std::size_t k = 0; k <= std::size_t(u.n); ++k) y.c[k] = -u.c[k];
  return y;
}

Series operator*(const Series& a, const Series& b) {
  Series y = same_kind(a, b);
  for (std::size_t k = 0; k <= std::size_t(a.n); ++k)
    for (std::size_t j = 0; j <= k; ++j) y.c[k] += a.c[j] * b.c[k - j];
  return y;
}

Series inverse(const Series& u) {
  Series y = same_kind(u);
  y.c[0] = 1.0 / u.c[0];
  for (std::size_t k = 1; k <= std::size_t(u.n); ++k) {
    Range sum;
    for (std::size_t j = 1; j <= k; ++j) sum += u.c[j] * y.c[k - j];
    y.c[k] = -(y.c[0] * sum);
  }
  return y;
}

Series power(const Series& u, double p) {
  const Range value = power_of_range(u.c[0], p);
  if (p == 0) return constant(1, u.n);
  if (p != std::floor(p) && u.c[0].lower() < 0) return unknown(u.n);
  Series y = same_kind(u);
  if (u.is_constant()) {
    y.c[0] = value;
    return y;
  }
  if (p == std::floor(p) && std::abs(p) <= largest_whole_power) {
    y.c[0] = 1;
    for (int i = 0; i < int(std::abs(p)); ++i) y = i == 0 ? u : y * u;
    if (p < 0) y = inverse(y);
    y.c[0] = value;
    return y;
  }
  y.c[0] = value;
  const Range over = 1.0 / u.c[0];
  for (int k = 1; k <= u.n; ++k) {
    Range sum;
    for (int j = 1; j <= k; ++j) sum += (p * j - (k - j)) * (u.c[std::size_t(j)] * y.c[std::size_t(k - j)]);
    y.c[std::size_t(k)] = (1.0 / k) * (over * sum);
  }
  return y;
}

Series power(const Series& u, const Series& w) {
  if (w.is_constant() && singleton(w.c[0])) return power(u, w.c[0].lower());
  return u.c[0].lower() < 0 ? unknown(u.n) : exp(w * log(u));
}

Series exp(const Series& u) {
  Series y = same_kind(u);
  y.c[0] = exp(u.c[0]);
  for (int k = 1; k <= u.n; ++k) y.c[std::size_t(k)] = (1.0 / k) * integral(u, y, k);
  return y;
}

Series log(const Series& u) {
  if (u.c[0].lower() < 0) return unknown(u.n);
  return primitive(log(u.c[0]), u, inverse(u));
}

Series sin(const Series& u) {
  return pair(sin(u.c[0]), cos(u.c[0]), u, -1).y;
}

Series cos(const Series& u) {
  return pair(sin(u.c[0]), cos(u.c[0]), u, -1).w;
}

Series tan(const Series& u) {
  return by_own_square(tan(u.c[0]), u, 1);
}

Series asin(const Series& u) {
  if (largest(u.c[0]) > 1) return unknown(u.n);
  const Range value = asin(u.c[0]);
  return primitive(value, u, power(constant(1, u.n) - u * u, -0.5));
}

Series acos(const Series& u) {
  return constant(std::numbers::pi / 2, u.n) - asin(u);
}

Series atan(const Series& u) {
  return primitive(atan(u.c[0]), u, inverse(constant(1, u.n) + power(u, 2)));
}

Series atan2(const Series& y, const Series& x) {
  const Range &a = y.c[0], &b = x.c[0];
  const Series over = inverse(power(x, 2) + power(y, 2));
  Series angle = same_kind(x, y);
  const bool turns = has_zero(a) && b.lower() <= 0;  // may pass from pi to -pi
  if (turns) {
    angle.c[0] = Range(-std::numbers::pi, std::numbers::pi);
    if (a.lower() < 0) angle.smooth = 0;
  } else {
    angle.c[0] = hull(Range::hull(std::atan2(a.lower(), b.lower()), std::atan2(a.lower(), b.upper())),
                      Range::hull(std::atan2(a.upper(), b.lower()), std::atan2(a.upper(), b.upper())));
  }
  Series rate = same_kind(x, y);  // x y' - y x'
  for (std::size_t k = 0; k < std::size_t(x.n); ++k)
    for (std::size_t j = 0; j <= k; ++j) {
      const double m = double(k - j + 1);
      rate.c[k] += m * (x.c[j] * y.c[k - j + 1] - y.c[j] * x.c[k - j + 1]);
    }
  rate = rate * over;
  for (std::size_t k = 1; k <= std::size_t(x.n); ++k) angle.c[k] = (1.0 / double(k)) * rate.c[k - 1];
  return angle;
}

Series sinh(const Series& u) {
  return pair(sinh(u.c[0]), cosh(u.c[0]), u, 1).y;
}

Series cosh(const Series& u) {
  return pair(sinh(u.c[0]), cosh(u.c[0]), u, 1).w;
}

Series tanh(const Series& u) {
  return by_own_square(tanh(u.c[0]), u, -1);
}

Series hull(const Series& a, const Series& b) {
  Series y = same_kind(a, b);
  for (std::size_t k = 0; k <= std::size_t(a.n); ++k) y.c[k] = hull(a.c[k], b.c[k]);
  return y;
}

Series abs(const Series& u) {
  return greatest(u, -u);
}

Series least(const Series& a, const Series& b) {
  if (empty(a.c[0]) || empty(b.c[0])) return unknown(a.n);
  if (a.c[0].upper() <= b.c[0].lower()) return a;
  if (b.c[0].upper() <= a.c[0].lower()) return b;
  Series y = hull(a, b);
  y.c[0] = min(a.c[0], b.c[0]);
  y.smooth = std::min(y.smooth, 1);
  return y;
}

Series greatest(const Series& a, const Series& b) {
  return -least(-a, -b);
}

Series piecewise_constant(double (*f)(double), const Series& u) {
  if (empty(u.c[0])) return unknown(u.n);
  Series y = constant(Range(f(u.c[0].lower()), f(u.c[0].upper())), u.n);
  if (!singleton(y.c[0])) y.smooth = 0;
  return y;
}

}  // namespace trammel::scene
