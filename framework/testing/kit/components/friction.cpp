// Friction laws: the force stays inside the cone and never drives; what is smooth has the slope it states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <trammel/friction.hpp>

#include "testing/difference.hpp"
#include "testing/kit/components/components.hpp"

namespace trammel::kit {

namespace {

constexpr ClaimsOf friction_claim{"friction.", "trammel/friction.hpp"};

void over_slips(const std::function<void(double)>& look) {
  for (double slip = 1e-12; slip < 2e6; slip *= 3) look(slip);
}

// --- smooth laws ---

using Smooth = SmoothFriction;

Report never_drives(const Subject& s) {
  const auto law = s.maker<Smooth>()();
  return compare("the force is against the slip", [&](Comparison& c) {
    over_slips([&](double slip) {
      const double ratio = law->ratio(slip);
      c.holds(ratio >= 0, fmt::format("F_t/F_n = {:.6g} at a slip of {:.3g} m/s: it drives", ratio, slip));
    });
  });
}

Report stays_in_a_cone(const Subject& s) {
  const auto law = s.maker<Smooth>()();
  return compare("F_t/F_n is bounded at any slip", [&](Comparison& c) {
    double largest = 0;
    for (double slip = 1e-9; slip < 10; slip *= 1.3) largest = std::max(largest, law->ratio(slip));
    // Viscous parts may grow; a cone has an opening all the same, far above what any pair of surfaces has.
    over_slips([&](double slip) {
      const double ratio = law->ratio(slip);
      c.holds(ratio <= std::max(100.0, 10 * largest),
              fmt::format("F_t/F_n = {:.6g} at a slip of {:.3g} m/s", ratio, slip));
    });
  });
}

Report starts_from_zero(const Subject& s) {
  const auto law = s.maker<Smooth>()();
  return compare("the force has no jump at rest", [&](Comparison& c) {
    c.within(law->ratio(0), 0, 0, "F_t/F_n at rest");
    double largest = 0;
    for (double slip = 1e-9; slip < 10; slip *= 1.3) largest = std::max(largest, law->ratio(slip));
    c.within(law->ratio(1e-15), 0, 1e-3 * largest, "F_t/F_n at 1e-15 m/s");
  });
}

Report slope_is_the_derivative(const Subject& s) {
  const auto law = s.maker<Smooth>()();
  std::mt19937 random = s.random(31);
  return compare("slope is the derivative of the ratio", [&](Comparison& c) {
    int smooth = 0;
    for (int i = 0; i < 40; ++i) {
      const double slip = std::pow(10, between(random, -6, 1));
      const auto ratio = [&](double d) { return Vec::Constant(1, law->ratio(slip + d)); };
      const Difference d = difference(ratio, 1e-3 * slip);
      // A law of pieces has kinks; they are few.
      if (d.error(0) > 1e-5 * (std::abs(d.value(0)) + d.size / d.h)) continue;
      ++smooth;
      c.derivative(Vec::Constant(1, law->slope(slip)), d, fmt::format("slope at {:.3g} m/s", slip));
    }
    c.holds(smooth >= 20, fmt::format("it has a derivative at {} of 40 slips only", smooth));
  });
}

// --- set-valued laws ---

using SetValued = SetValuedFriction;

Report holds_more_at_rest(const Subject& s) {
  const auto law = s.maker<SetValued>()();
  return compare("sliding friction is inside the cone of sticking", [&](Comparison& c) {
    const double mu_0 = law->static_coefficient();
    c.holds(mu_0 >= 0 && std::isfinite(mu_0), fmt::format("mu_0 = {:.6g}", mu_0));
    over_slips([&](double slip) {
      const double mu = law->kinetic_coefficient(slip);
      c.holds(mu <= mu_0 * (1 + 1e-15), fmt::format("mu({:.3g} m/s) = {:.6g}, mu_0 = {:.6g}", slip, mu, mu_0));
    });
  });
}

Report sliding_never_drives(const Subject& s) {
  const auto law = s.maker<SetValued>()();
  return compare("sliding friction is against the slip", [&](Comparison& c) {
    over_slips([&](double slip) {
      const double mu = law->kinetic_coefficient(slip);
      c.holds(mu >= 0, fmt::format("mu({:.3g} m/s) = {:.6g}: it drives", slip, mu));
    });
  });
}

Report decides_by_a_speed(const Subject& s) {
  const auto law = s.maker<SetValued>()();
  return compare("the speed below which it sticks is finite, and not negative", [&](Comparison& c) {
    const double speed = law->stick_speed();
    c.holds(speed >= 0 && std::isfinite(speed), fmt::format("stick_speed() = {:.6g} m/s", speed));
  });
}

}  // namespace

Checks smooth_friction_checks() {
  const char* const ratio = "F_t/F_n; 0 at slip = 0, so that the force has no jump";
  const char* const law = "A force that is smooth in the slip velocity: F_t = -ratio(|s|) F_n s/|s|.";
  return {{friction_claim("never-drives", "Friction acts against the slip.", "ratio(|s|) >= 0", law), Level::quick,
           never_drives},
          {friction_claim("stays-inside-its-cone", "The tangential force is bounded by the normal force.",
                          "|F_t| <= mu F_n", law),
           Level::quick, stays_in_a_cone},
          {friction_claim("starts-from-zero", "The force has no jump at rest.", "ratio(0) = 0", ratio), Level::quick,
           starts_from_zero},
          {friction_claim("slope-is-the-derivative", "The slope is the derivative of the ratio.",
                          "slope = d(ratio)/d(slip)", "its derivative [s/m]"),
           Level::quick, slope_is_the_derivative}};
}

Checks set_valued_friction_checks() {
  return {
      {friction_claim("stays-inside-its-cone", "What slides is held no more than what rests.", "0 <= mu(|s|) <= mu_0",
                      "mu(|s|) <= mu_0"),
       Level::quick, holds_more_at_rest},
      {friction_claim("never-drives", "Friction acts against the slip.", "mu(|s|) >= 0", "F_t = -mu(|s|) F_n s/|s|."),
       Level::quick, sliding_never_drives},
      {friction_claim("decides-by-a-speed", "There is a speed below which it sticks.", "0 <= stick speed < infinity",
                      "The contact sticks below this slip. 0: chosen from the scene"),
       Level::quick, decides_by_a_speed}};
}

}  // namespace trammel::kit
