// Newton's iteration on a cubic spring begins far from the solution, where each increment is two thirds of the one
// before: the step ends at its solution or is rejected, and nowhere between.
#include <cmath>

#include "support.hpp"

namespace trammel::test {
namespace {

constexpr double stiffness = 1e3;  // [N/m^3]

Problem cubic_spring() {
  Problem p;
  p.name = "cubic spring";
  p.M = Mat::Identity(1, 1);
  p.force = [](double, const Vec& q, const Vec&) { return Vec::Constant(1, -stiffness * std::pow(q[0], 3)); };
  p.exact = [](double, Vec& q, Vec& v) { q = Vec::Ones(1), v = Vec::Zero(1); };
  p.closed_form = false;
  return p;
}

// The trapezoidal rule: M a = f at the step's end.
TEST(Newmark, SolvesItsEquationsHoweverSlowlyNewtonConverges) {
  int accepted = 0;
  for (double h = 0.01; h < 1; h *= 1.2) {
    Posed system(cubic_spring());
    auto method = make("newmark", {});
    State now = system.start(), next;
    method->restart(system, now);
    if (!method->step(system, now, h, next)) continue;
    ++accepted;
    const double q = next.q[0], size = std::max(1.0, std::abs(q));
    // Newton's tolerance, 1e-11 of the size of q, times f', and 1000 times as much for its estimate of what is left.
    EXPECT_NEAR(next.a[0], -stiffness * q * q * q, 1e-8 * (3 * stiffness * q * q * size + std::abs(next.a[0]))) << h;
  }
  EXPECT_GE(accepted, 10);
}

}  // namespace
}  // namespace trammel::test
