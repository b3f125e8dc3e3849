#include "static_functions.hpp"

#include <cmath>

#include <trammel/decompositions.hpp>
#include <trammel/quadrature.hpp>

namespace trammel::beam {

template <class ModeType>
double StaticFunction<ModeType>::value(double x) const {
  double s = x * (p[0] + x * (p[1] + x * p[2]));
  for (std::size_t i = 0; i < modes.size(); ++i) s -= c[i] * modes[i].value(x);
  return s;
}

template <class ModeType>
double StaticFunction<ModeType>::slope(double x) const {
  double s = p[0] + x * (2 * p[1] + x * 3 * p[2]);
  for (std::size_t i = 0; i < modes.size(); ++i) s -= c[i] * modes[i].slope(x);
  return s;
}

template struct StaticFunction<BendingMode>;
template struct StaticFunction<AxialMode>;

namespace {

using Bending = StaticFunction<BendingMode>;

double curvature(const Bending& s, double x) {
  double sum = 2 * s.p[1] + 6 * s.p[2] * x;
  for (std::size_t i = 0; i < s.modes.size(); ++i) sum -= s.c[i] * s.modes[i].curvature(x);
  return sum;
}

// Products of two such functions have 2 N half waves.
Quadrature rule_for(std::size_t modes, double L) {
  return gauss_legendre(int(4 * modes) + 12, 0, L);
}

Bending combination(double a, const Bending& first, double b, const Bending& second) {
  Bending s = first;
  for (std::size_t i = 0; i < s.p.size(); ++i) s.p[i] = a * first.p[i] + b * second.p[i];
  for (std::size_t i = 0; i < s.c.size(); ++i) s.c[i] = a * first.c[i] + b * second.c[i];
  return s;
}

// s_1 = (x/L)^2 and s_2 = 3 (x/L)^2 - (x/L)^3 minus their projections on the modes. By parts, with Phi = Phi''''/b^4,
//     int x^2 Phi dx = 2 Phi'(L)/b^4,   int x^3 Phi dx = 6 (L Phi'(L) - Phi(L))/b^4.
std::array<Bending, 2> beyond_the_modes(double L, const std::vector<BendingMode>& modes) {
  const double L2 = L * L, L3 = L2 * L;
  std::array<Bending, 2> s{Bending{{0, 1 / L2, 0}, modes, {}}, Bending{{0, 3 / L2, -1 / L3}, modes, {}}};
  for (const BendingMode& mode : modes) {
    const double b4 = std::pow(mode.wave_number(), 4), slope = mode.slope(L);
    const double of_2 = 2 * slope / b4, of_3 = 6 * (L * slope - mode.value(L)) / b4;
    s[0].c.push_back(of_2 / L3);
    s[1].c.push_back((3 * of_2 - of_3 / L) / L3);
  }
  return s;
}

}  // namespace

std::vector<Bending> static_bending(double L, const std::vector<BendingMode>& modes) {
  const std::array<Bending, 2> s = beyond_the_modes(L, modes);
  Mat mass = Mat::Zero(2, 2), stiffness = mass;
  const Quadrature rule = rule_for(modes.size(), L);
  for (Eigen::Index g = 0; g < rule.x.size(); ++g) {
    const double x = rule.x(g), w = rule.weight(g);
    const Eigen::Vector2d at(s[0].value(x), s[1].value(x)), bent(curvature(s[0], x), curvature(s[1], x));
    mass += w * at * at.transpose();
    stiffness += w * bent * bent.transpose();
  }
  // Scaled alike, otherwise the smaller one loses digits.
  const Eigen::Vector2d scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Mat K = scale.asDiagonal() * stiffness * scale.asDiagonal(), M = scale.asDiagonal() * mass * scale.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat> solver(K, M);
  std::vector<Bending> both;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d y = std::sqrt(L) * scale.cwiseProduct(solver.eigenvectors().col(k));
    both.push_back(combination(y(0), s[0], y(1), s[1]));
    both.back().stiffness = L * solver.eigenvalues()(k);
  }
  return both;
}

// int x sin(l x) dx = sin(l L)/l^2, as cos(l L) = 0.
StaticFunction<AxialMode> static_stretching(double L, const std::vector<AxialMode>& modes) {
  StaticFunction<AxialMode> s{{1 / L, 0, 0}, modes, {}};
  for (const AxialMode& mode : modes) s.c.push_back(2 * mode.value(L) / std::pow(L * mode.wave_number(), 2));
  double mass = 0;
  const Quadrature rule = rule_for(modes.size(), L);
  for (Eigen::Index g = 0; g < rule.x.size(); ++g) {
    mass += rule.weight(g) * std::pow(s.value(rule.x(g)), 2);
    s.stiffness += rule.weight(g) * std::pow(s.slope(rule.x(g)), 2);
  }
  const double scale = std::sqrt(L / 2 / mass);
  s.p[0] *= scale;
  for (double& c : s.c) c *= scale;
  s.stiffness *= scale * scale;
  return s;
}

}  // namespace trammel::beam
