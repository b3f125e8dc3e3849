// A torsion spring in the hinge of two arms, unloaded when they are straight, as a force between the arms' far ends A
// and B.
//
//     e = |x_B - x_A|,   e^2 = a^2 + b^2 + 2 a b cos(psi)          psi [rad] the bend: 0 straight, pi folded
//     U = kappa psi^2 / 2,   force along AB  -dU/de = kappa (psi / sin(psi)) e / (a b)       pushes the ends apart
//     force on A  -p d,  d = x_B - x_A,  p = kappa (psi / sin(psi)) / (a b),   d(p d)/dd = p 1 - dp/dw d d^T / (a b)
//
// with w = 1 - cos(psi), dw/d(e^2) = -1/(2 a b). psi/sin(psi) is an even function of psi and regular at the straight
// position, where e = a + b, and beyond it, where the arms are stretched. (Arms in natural coordinates have no axes for
// a torsional spring.) psi = pi, arms of equal length folded onto each other, is a dead point, where the force is
// unbounded.
#include <algorithm>
#include <cmath>

#include <trammel/force.hpp>
#include <trammel/outside_domain.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct HingeSpring : Force, WrenchTangent {
  double stiffness = 0;
  std::vector<double> arms;

  void prepare(const World&) override {
    if (arms.size() == 1) arms.push_back(arms[0]);
    if (arms.size() != 2) throw ParameterError("arms", "expected one length for both arms, or two: [a, b]");
  }

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const Vec3 d = B.x - A.x;
    const Bend bend = bend_of(d.squaredNorm());
    if (bend.cosine <= -1) throw OutsideDomain("its arms are folded onto each other, where its force has no bound");
    const Vec3 push = stiffness * bend.over_sine / (arms[0] * arms[1]) * d;
    on_B.head(d.size()) += push;
    on_A.head(d.size()) -= push;
  }
  double potential(double, const Motion& A, const Motion& B) const override {
    return stiffness / 2 * bend_of((B.x - A.x).squaredNorm()).square;
  }
  Power power(double, const Motion&, const Motion&) const override { return {}; }

  void add_wrench_tangent(double, const Motion& A, const Motion& B, PairTangent& K, PairTangent&) const override {
    const Vec3 d = B.x - A.x;
    const Bend bend = bend_of(d.squaredNorm());
    const double ab = arms[0] * arms[1], p = stiffness * bend.over_sine / ab, dp_dw = stiffness * bend.slope() / ab;
    add_by_distance(dp_dw / ab * d * d.transpose() - p * Mat3::Identity(d.size(), d.size()), K);
  }

 private:
  static constexpr double near_straight = 1e-3;  // w below which functions of the bend are summed as series

  struct Bend {
    double cosine, square, over_sine;  // cos(psi), psi^2, psi/sin(psi)

    // d(psi/sin(psi))/dw = (1 - psi cos(psi)/sin(psi)) / sin(psi)^2
    double slope() const {
      const double w = 1 - cosine;
      if (std::abs(w) < near_straight) return 1.0 / 3 + w * (4.0 / 15 + w * (6.0 / 35 + w * (32.0 / 315)));
      return (1 - over_sine * cosine) / (w * (2 - w));
    }
  };
  // With w = 1 - cos(psi) near straight: psi^2 = 2 w + w^2/3 + 4 w^3/45 + ..., whatever the sign of w.
  Bend bend_of(double e_squared) const {
    const double a = arms[0], b = arms[1], w = ((a + b) * (a + b) - e_squared) / (2 * a * b);
    if (std::abs(w) < near_straight)
      return {1 - w, w * (2 + w * (1.0 / 3 + w * (4.0 / 45 + w * (1.0 / 35 + w * (16.0 / 1575))))),
              1 + w * (1.0 / 3 + w * (2.0 / 15 + w * (2.0 / 35 + w * (8.0 / 315))))};
    if (w < 0) {  // stretched: psi is imaginary, even functions of it are real
      const double size = std::acosh(1 - w);
      return {1 - w, -size * size, size / std::sinh(size)};
    }
    const double psi = std::acos(std::max(1 - w, -1.0));
    return {1 - w, psi * psi, psi / std::sin(psi)};
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::force<HingeSpring>("hinge_spring", "torsion spring of a hinge between two arms, by their far ends")
        .source("law of cosines; Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77: folding members")
        .parameter("stiffness", &HingeSpring::stiffness,
                   {.unit = "N m/rad", .min = 0, .required = true, .doc = "kappa; at rest where the arms are straight"})
        .parameter("arms", &HingeSpring::arms,
                   {.unit = "m",
                    .min = 0,
                    .above_min = true,
                    .required = true,
                    .doc = "lengths: one number for both, or two"}))
