// Regularised Coulomb friction. The contact never sticks; it creeps with speeds up to about v_c.
//
//     tanh        T = -mu N tanh(y),       y = slip / v_c
//     quadratic   T = -mu N y (2 - y) up to y = 1, -mu N beyond
//
// In impacts of rigid contacts it counts as Coulomb's law (framework/simulate/impact/impact_friction.hpp).
#include <cmath>

#include <trammel/fidelity.hpp>
#include <trammel/friction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct RegularizedCoulomb : SmoothFriction, HasFidelity {
  enum class Form { tanh, quadratic };
  double mu = 0, v_c = 1e-3;
  Form form = Form::tanh;

  double ratio(double slip) const override {
    const double y = slip / v_c;
    if (form == Form::quadratic) return y < 1 ? mu * y * (2 - y) : mu;
    return mu * std::tanh(y);
  }
  std::vector<FidelityParameter> fidelity() const override {
    return {{"critical_velocity", FidelityParameter::Costs::more_if_smaller}};
  }
  // Its limit as v_c goes to 0.
  std::vector<FidelityAlternative> alternatives() const override { return {{"coulomb", {{"coefficient", mu}}, true}}; }
  double slope(double slip) const override {
    if (form == Form::quadratic) return slip < v_c ? 2 * mu / v_c * (1 - slip / v_c) : 0;
    const double sech = 1 / std::cosh(std::min(slip / v_c, 300.0));
    return mu / v_c * sech * sech;
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::friction<RegularizedCoulomb>("regularized_coulomb", "dry friction made smooth: it creeps, never sticks")
        .source("E. Pennestri, V. Rossi, P. Salvini, P. P. Valentini, Nonlinear Dyn. 83, 1785 (2016): a review")
        .parameter("coefficient", &RegularizedCoulomb::mu,
                   {.min = 0,
                    .usual_max = 10,
                    .required = true,
                    .doc = "mu; impacts faster than v_c take Coulomb's law with it"})
        .parameter("critical_velocity", &RegularizedCoulomb::v_c,
                   {.unit = "m/s",
                    .min = 0,
                    .above_min = true,
                    .doc = "v_c: 76 % of the force is reached there, all with quadratic"})
        .choice("form", &RegularizedCoulomb::form,
                {{"tanh", RegularizedCoulomb::Form::tanh}, {"quadratic", RegularizedCoulomb::Form::quadratic}},
                {.doc = "how the force rises"}))
