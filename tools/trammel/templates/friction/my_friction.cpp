// Coulomb's friction made smooth, to change:
//
//     F_t = -mu F_n y/sqrt(1 + y^2),   y = slip/v_s
#include <cmath>

#include <trammel/friction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct MyFriction final : SmoothFriction {
  double mu = 0.3, v_s = 1e-3;

  double ratio(double slip) const override { return mu * (slip / v_s) / root(slip); }
  double slope(double slip) const override { return mu / v_s / std::pow(root(slip), 3); }

 private:
  double root(double slip) const { return std::hypot(1, slip / v_s); }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::friction<MyFriction>("my_friction", "smooth dry friction, to change")
                   .source("Pennestri et al. 2016, Nonlinear Dyn. 83, 1785: a review")
                   .parameter("coefficient", &MyFriction::mu, {.min = 0, .usual_max = 10, .doc = "mu"})
                   .parameter("transition_speed", &MyFriction::v_s,
                              {.unit = "m/s", .min = 0, .above_min = true, .doc = "v_s: 71 % of mu is reached there"}))
