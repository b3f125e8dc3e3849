// The method of Hilber, Hughes and Taylor for constrained mechanical systems: the alpha method
// (methods/alpha_method.hpp) with
//
//     alpha_m = 0,   alpha_f = -alpha,   gamma = 1/2 - alpha,   beta = (1 - alpha)^2 / 4,   alpha in [-1/3, 0]
//
// Some texts write alpha for our -alpha. For constant M this is the original form
//     1/(1+alpha) M a_{n+1} - (f - W^T lambda)_{n+1} + alpha/(1+alpha) (f - W^T lambda)_n = 0
// Negrut, Rampalli, Ottarsson, Sajdak, J. Comput. Nonlinear Dynam. 2(1), 73-85 (2007); Jay, Negrut, ETNA 26, 190-208
// (2007).
#include <trammel/methods/alpha_integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

struct HhtAlpha : trammel::Component {
  double alpha = -0.1;

  trammel::AlphaMethod::Weights weights() const {
    return {.alpha_m = 0, .alpha_f = -alpha, .beta = (1 - alpha) * (1 - alpha) / 4, .gamma = 0.5 - alpha};
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::alpha_integrator<HhtAlpha>(
    trammel::part<HhtAlpha>("hht_alpha", "HHT-alpha: second order, damps the modes too fast for the step")
        .source("Negrut et al. 2007, J. Comput. Nonlinear Dynam. 2(1), 73-85; Jay, Negrut 2007, ETNA 26, 190-208")
        .parameter("alpha", &HhtAlpha::alpha,
                   {.min = -1.0 / 3, .max = 0, .doc = "numerical damping; 0 is the trapezoidal rule without any"})))
