// Routh's construction: the impact of one contact in the plane with friction and energetic restitution, exactly.
//
//     u' = a N + b T,  s' = b N + c T     rates of gap and slip by the impulses N and T
//
// Rates are linear in N while the slip keeps its direction or stays 0. Compression ends where u is 0, expansion where
// the normal force has done e^2 times its work.
#pragma once

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Core>

namespace trammel::test {

struct Struck {
  double a, b, c;  // [1/kg]
  double u, s;     // [m/s] before
};

// (N, T) [N s].
inline Eigen::Vector2d routh(const Struck& contact, double e, double mu) {
  auto [a, b, c, u, s] = contact;
  constexpr double never = 1e300;
  Eigen::Vector2d P(0, 0);
  double work = 0, due = 0;  // of the normal force; where the expansion ends
  bool expands = false;
  for (int piece = 0; piece < 10; ++piece) {
    const bool sticks = s == 0 && std::abs(b) <= mu * c;
    const double side = s != 0 ? (s > 0 ? 1 : -1) : (b > 0 ? 1 : -1);
    const double ratio = sticks ? -b / c : -mu * side, du = a + ratio * b, ds = sticks ? 0 : b + ratio * c;
    const double to_stop = s != 0 && s * ds < 0 ? -s / ds : never;
    const double to_turn = !expands && du > 0 ? -u / du : never;
    const double to_end = expands ? (-u + std::sqrt(u * u + 2 * du * (due - work))) / du : never;
    const double dN = std::min({to_stop, to_turn, to_end});
    work += u * dN + du * dN * dN / 2;
    P += dN * Eigen::Vector2d(1, ratio);
    u = dN == to_turn ? 0 : u + du * dN;
    s = dN == to_stop ? 0 : s + ds * dN;
    if (dN == to_turn) expands = true, due = (1 - e * e) * work;
    if (dN == to_end || (expands && e == 0)) return P;
  }
  ADD_FAILURE() << "it does not end";
  return P;
}

}  // namespace trammel::test
