#include "modes.hpp"

#include <cmath>
#include <numbers>

namespace trammel::beam {

namespace {

constexpr double last_step = 1e-16;  // of Newton's method, relative to z

// The i-th root z of cos z = -1 / cosh z, by Newton from the asymptotic (i - 1/2) pi.
double root(int i) {
  double z = (i - 0.5) * std::numbers::pi;
  if (i == 1) z = 1.875;
  for (int k = 0; k < 20; ++k) {
    const double c = std::cosh(z);
    const double step = (std::cos(z) + 1 / c) / (-std::sin(z) - std::tanh(z) / c);
    z -= step;
    if (std::abs(step) < last_step * z) break;
  }
  return z;
}

}  // namespace

// With D = 1 - e^-2bL + 2 e^-bL sin bL:  1 - sigma = 2 e^-bL (sin bL - cos bL - e^-bL) / D,  and then
//     (1 - sigma) sinh bx = growing (e^-b(L-x) - e^-b(L+x)),   (1 - sigma) cosh bx = growing (e^-b(L-x) + e^-b(L+x)).
BendingMode::BendingMode(int i, double L) : L_(L) {
  const double z = root(i), decay = std::exp(-z);
  b_ = z / L;
  growing_ = (std::sin(z) - std::cos(z) - decay) / (1 - decay * decay + 2 * decay * std::sin(z));
  sigma_ = 1 - 2 * decay * growing_;
}

// cosh - sigma sinh = e^-bx + (1 - sigma) sinh bx;   sinh - sigma cosh = -e^-bx + (1 - sigma) cosh bx.
double BendingMode::value(double x) const {
  const double z = b_ * x;
  return std::exp(-z) + growing_ * (std::exp(b_ * (x - L_)) - std::exp(-b_ * (x + L_))) - std::cos(z) +
         sigma_ * std::sin(z);
}

double BendingMode::slope(double x) const {
  const double z = b_ * x;
  return b_ * (-std::exp(-z) + growing_ * (std::exp(b_ * (x - L_)) + std::exp(-b_ * (x + L_))) + std::sin(z) +
               sigma_ * std::cos(z));
}

// cosh + cos - sigma (sinh + sin)
double BendingMode::curvature(double x) const {
  const double z = b_ * x;
  return b_ * b_ *
         (std::exp(-z) + growing_ * (std::exp(b_ * (x - L_)) - std::exp(-b_ * (x + L_))) + std::cos(z) -
          sigma_ * std::sin(z));
}

AxialMode::AxialMode(int i, double L) : l_((2 * i - 1) * std::numbers::pi / (2 * L)) {}

double AxialMode::value(double x) const {
  return std::sin(l_ * x);
}

double AxialMode::slope(double x) const {
  return l_ * std::cos(l_ * x);
}

}  // namespace trammel::beam
