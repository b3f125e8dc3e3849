// The generalised-alpha method for constrained mechanical systems: the alpha method (methods/alpha_method.hpp) with
//
//     alpha_m = (2 rho - 1)/(rho + 1),   alpha_f = rho/(rho + 1)
//     gamma = 1/2 + alpha_f - alpha_m,   beta = (gamma + 1/2)^2 / 4
//
// rho in [0, 1] is the spectral radius for infinitely fast modes.
// Chung, Hulbert, J. Appl. Mech. 60(2), 371-375 (1993); Arnold, Bruls, Multibody Syst. Dyn. 18, 185-202 (2007).
#include <trammel/methods/alpha_integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

struct GeneralizedAlpha : trammel::Component {
  double rho_inf = 0.9;

  trammel::AlphaMethod::Weights weights() const {
    const double alpha_m = (2 * rho_inf - 1) / (rho_inf + 1), alpha_f = rho_inf / (rho_inf + 1);
    const double gamma = 0.5 + alpha_f - alpha_m;
    return {.alpha_m = alpha_m, .alpha_f = alpha_f, .beta = (gamma + 0.5) * (gamma + 0.5) / 4, .gamma = gamma};
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::alpha_integrator<GeneralizedAlpha>(
    trammel::part<GeneralizedAlpha>("generalized_alpha", "generalised alpha: second order, damping chosen by rho_inf")
        .source(
            "Chung, Hulbert 1993, J. Appl. Mech. 60(2), 371-375; Arnold, Bruls 2007, Multibody Syst. Dyn. 18, 185-202")
        .parameter(
            "rho_inf", &GeneralizedAlpha::rho_inf,
            {.min = 0,
             .max = 1,
             .doc =
                 "spectral radius for infinitely fast modes: 1 no damping (weakly unstable with index3), 0 one step"})))
