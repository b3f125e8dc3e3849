// Taylor coefficients of a function of t, for t anywhere in an interval: ranges of f, f', f''/2, ..., f^(n)/n!.
//
// The coefficients of a formula follow from those of its parts by recurrences: products by Cauchy's rule, functions by
// their differential equations, such as k y_k = sum_j j u_j y_(k-j) for y = exp(u). Source: Moore, Kearfott, Cloud,
// Introduction to Interval Analysis, 2009.
#pragma once

#include <array>

#include "scene/laws/range.hpp"

namespace trammel::scene {

struct Series {
  static constexpr int most = 6;  // largest n

  std::array<Range, most + 1> c;  // empty: nothing is known
  int n = most;                   // highest coefficient that is computed
  int smooth = most;              // f^(smooth) is bounded and lower derivatives have no jump; 0: f itself may jump

  Range derivative(int k) const;  // f^(k)
  bool is_constant() const;
};

Series constant(const Range& value, int n);
Series variable(const Range& t, int n);  // t itself

Series operator+(const Series& a, const Series& b);
Series operator-(const Series& a, const Series& b);
Series operator*(const Series& a, const Series& b);
Series operator-(const Series& u);
Series inverse(const Series& u);
Series power(const Series& u, const Series& w);
Series power(const Series& u, double p);
Series exp(const Series& u);
Series log(const Series& u);
Series sin(const Series& u);
Series cos(const Series& u);
Series tan(const Series& u);
Series asin(const Series& u);
Series acos(const Series& u);
Series atan(const Series& u);
Series atan2(const Series& y, const Series& x);
Series sinh(const Series& u);
Series cosh(const Series& u);
Series tanh(const Series& u);

// Where the arguments leave open which branch holds, both count.
Series abs(const Series& u);
Series least(const Series& a, const Series& b);
Series greatest(const Series& a, const Series& b);
Series piecewise_constant(double (*f)(double), const Series& u);  // f does not fall
Series hull(const Series& a, const Series& b);

}  // namespace trammel::scene
