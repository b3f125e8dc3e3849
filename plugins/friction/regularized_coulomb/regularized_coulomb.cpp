// Coulomb's friction made smooth: T = -mu N tanh(slip / v_c). It sticks nowhere, it creeps with up to v_c.
#include <cmath>

#include <trammel/friction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct RegularizedCoulomb : SmoothFriction {
  double mu = 0, v_c = 1e-3;

  double ratio(double slip) const override { return mu * std::tanh(slip / v_c); }
  double slope(double slip) const override {
    const double sech = 1 / std::cosh(std::min(slip / v_c, 300.0));
    return mu / v_c * sech * sech;
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::friction<RegularizedCoulomb>("regularized_coulomb", "dry friction made smooth: it creeps, never sticks")
        .source("E. Pennestri, V. Rossi, P. Salvini, P. P. Valentini, Nonlinear Dyn. 83, 1785 (2016): a review")
        .parameter("coefficient", &RegularizedCoulomb::mu, {.min = 0, .usual_max = 10, .required = true, .doc = "mu"})
        .parameter("critical_velocity", &RegularizedCoulomb::v_c,
                   {.unit = "m/s", .min = 0, .above_min = true, .doc = "v_c: 76 % of the force is reached there"}))
