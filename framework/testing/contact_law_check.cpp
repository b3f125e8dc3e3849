// The contract of a contact law. A compliant law F(gap, gap_rate, approach speed) with stored energy V(gap), tried in
// the impact of a mass m at the claimed speed, whose depth d follows from V(-d) = m v^2/2:
//
//     F >= 0;  F = V = 0 apart;  F -> 0 as the gap closes, if claimed
//     F(gap, 0) = -dV/dgap;  slope = dF/d(gap, gap_rate)
//     m v^2/2 + V never grows along m x'' = F
//
// A set-valued law: restitution in [0, 1] at any speed, and 0 below a capture speed above 0, which ends a sequence of
// bounces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <trammel/testing/components.hpp>

#include "testing/difference.hpp"

namespace trammel {
namespace {

struct TriedLaw {
  std::unique_ptr<ContactForce> law;
  ContactClaims claims;
  double energy, depth = 1e-12;  // [J] of the approach; [m] where it is stored

  TriedLaw(const MakerOf<ContactForce>& make, const ContactClaims& c)
      : law(make()), claims(c), energy(c.mass * c.speed * c.speed / 2) {
    while (law->potential(-depth) < energy && depth < 1e6) depth *= 2;
    double above = depth / 2;
    for (int i = 0; i < 60; ++i) {
      const double middle = (above + depth) / 2;
      (law->potential(-middle) < energy ? above : depth) = middle;
    }
  }
  double normal(double gap, double rate) const { return law->normal(gap, rate, claims.speed); }
};

Report never_pulls(const TriedLaw& l) {
  return compare("the force is never negative", [&](Comparison& c) {
    for (double gap = -2; gap <= 1; gap += 0.05)
      for (double rate = -10; rate <= 10; rate += 0.25)
        for (const double approach : {0.0, 1e-6, 1.0, 100.0}) {
          const double F = l.law->normal(gap * l.depth, rate * l.claims.speed, approach * l.claims.speed);
          c.holds(F >= 0, fmt::format("{:.6g} N at gap {:.6g} m, rate {:.6g} m/s, approach {:.6g} m/s", F,
                                      gap * l.depth, rate * l.claims.speed, approach * l.claims.speed));
        }
  });
}

Report is_nothing_apart(const TriedLaw& l) {
  return compare("no force and no energy while apart", [&](Comparison& c) {
    for (const double gap : {0.0, 1e-9, 0.5, 10.0}) {
      c.within(l.law->potential(gap * l.depth), 0, 0, fmt::format("energy at gap {:.3g} m", gap * l.depth));
      for (const double rate : {-1.0, 0.0, 1.0})
        c.within(l.normal(gap * l.depth, rate * l.claims.speed), 0, 0,
                 fmt::format("force at gap {:.3g} m", gap * l.depth));
    }
  });
}

// Down to 1e-12 of the depth, where F ~ depth^n is below 1e-5 of its maximum for any n above 0.42.
Report starts_from_zero(const TriedLaw& l) {
  return compare("the force starts from zero, if claimed", [&](Comparison& c) {
    if (!l.claims.starts_from_zero) return;
    for (const double rate : {-1.0, -0.1, 0.0, 1.0}) {
      const double most = std::max(l.normal(-l.depth, rate * l.claims.speed), l.normal(-l.depth, 0));
      c.within(l.normal(-1e-12 * l.depth, rate * l.claims.speed), 0, 1e-5 * most,
               fmt::format("force at the touch at {:.3g} m/s", rate * l.claims.speed));
    }
  });
}

Report potential_is_the_elastic_energy(const TriedLaw& l) {
  return compare("the force at rest is minus the gradient of the potential", [&](Comparison& c) {
    c.holds(l.depth < 1e6, "the potential never reaches the energy of the approach");
    for (const double part : {0.2, 0.6, 1.0}) {
      const double gap = -part * l.depth;
      const auto V = [&](double s) { return Vec::Constant(1, -l.law->potential(gap + s)); };
      c.derivative(Vec::Constant(1, l.normal(gap, 0)), difference(V, 0.1 * part * l.depth),
                   fmt::format("at gap {:.3g} m", gap));
    }
  });
}

Report slope_is_the_derivative(const TriedLaw& l) {
  return compare("slope is the derivative of the force", [&](Comparison& c) {
    for (const double part : {0.2, 0.6, 1.0})
      for (const double rate : {-1.0, -0.3, 0.1, 0.4}) {
        const double gap = -part * l.depth, v = rate * l.claims.speed, h_gap = 0.02 * -gap, h_rate = 0.1 * std::abs(v);
        // Where a law limits a pull to 0 there is a kink.
        const double least = std::min(
            {l.normal(gap - h_gap, v), l.normal(gap + h_gap, v), l.normal(gap, v - h_rate), l.normal(gap, v + h_rate)});
        if (least == 0) continue;
        const ContactForce::Slope slope = l.law->slope(gap, v, l.claims.speed);
        const std::string where = fmt::format("at gap {:.3g} m, rate {:.3g} m/s", gap, v);
        const auto by_gap = [&](double s) { return Vec::Constant(1, l.normal(gap + s, v)); };
        const auto by_rate = [&](double s) { return Vec::Constant(1, l.normal(gap, v + s)); };
        c.derivative(Vec::Constant(1, slope.by_gap), difference(by_gap, h_gap), where + ": by gap");
        c.derivative(Vec::Constant(1, slope.by_rate), difference(by_rate, h_rate), where + ": by rate");
      }
  });
}

// The classical Runge-Kutta method in 4000 steps over the time to cross the depth; a contact may last 100 times that.
Report energy_never_grows(const TriedLaw& l) {
  return compare("energy never grows over an impact", [&](Comparison& c) {
    const double h = l.depth / l.claims.speed / 4000;
    const auto a = [&](double x, double v) { return l.normal(x, v) / l.claims.mass; };
    // From just inside, without the step that ends outside: a law may jump at the touch.
    double x = -1e-9 * l.depth, v = -l.claims.speed, gain = 0;
    double least = l.claims.mass * v * v / 2 + l.law->potential(x);
    for (int i = 0; i < 400000; ++i) {
      const double a1 = a(x, v), a2 = a(x + h / 2 * v, v + h / 2 * a1);
      const double a3 = a(x + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2);
      const double a4 = a(x + h * v + h * h / 2 * a2, v + h * a3);
      x += h * v + h * h / 6 * (a1 + a2 + a3);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      if (!(x < 0)) break;
      const double energy = l.claims.mass * v * v / 2 + l.law->potential(x);
      gain = std::max(gain, energy - least);
      least = std::min(least, energy);
    }
    // Error of the method: 4000^-2.5 where the force starts as a power of the depth, and where a limited law releases.
    c.within(gain / l.energy, 0, 1e-7, "gain over the energy of the approach");
  });
}

Report restitution_loses_energy(const Restitution& law) {
  return compare("restitution is in [0, 1] at any speed", [&](Comparison& c) {
    for (double speed = 1e-12; speed < 2e6; speed *= 3) {
      const double e = law.coefficient(speed);
      c.holds(e >= 0 && e <= 1, fmt::format("{:.17g} at {:.3g} m/s", e, speed));
    }
  });
}

Report bounces_end(const Restitution& law) {
  return compare("slower than its capture speed nothing bounces (0: the scene's size decides)", [&](Comparison& c) {
    const double capture = law.treatment().capture_speed;
    c.holds(capture >= 0 && std::isfinite(capture), fmt::format("capture speed {:.6g} m/s", capture));
    for (const double part : {0.0, 1e-6, 0.5, 0.999})
      if (capture > 0)
        c.within(law.coefficient(part * capture), 0, 0, fmt::format("restitution at {:.3g} m/s", part * capture));
  });
}

}  // namespace

std::vector<Check> contact_force_checks(const MakerOf<ContactForce>& make, const ContactClaims& claims) {
  using Look = Report (*)(const TriedLaw&);
  const std::pair<const char*, Look> all[] = {
      {"NeverPulls", never_pulls},
      {"IsNothingApart", is_nothing_apart},
      {"StartsFromZero", starts_from_zero},
      {"PotentialIsTheElasticEnergy", potential_is_the_elastic_energy},
      {"SlopeIsTheDerivative", slope_is_the_derivative},
      {"EnergyNeverGrows", energy_never_grows},
  };
  std::vector<Check> checks;
  for (const auto& [name, look] : all) checks.push_back({name, [=] { return look(TriedLaw(make, claims)); }});
  return checks;
}

std::vector<Check> restitution_checks(const MakerOf<Restitution>& make) {
  return {{"LosesEnergy", [=] { return restitution_loses_energy(*make()); }},
          {"EndsASequenceOfBounces", [=] { return bounces_end(*make()); }}};
}

}  // namespace trammel
