// The alpha methods with auxiliary accelerations (trammel/methods/alpha_method.hpp), one step of h = 1 on x'' = -W^2 x
// with the state (x, v, a), A = -W^2 x:
//
//     x_1 = x + v + (1/2 - beta) a + beta a_1,   v_1 = v + (1 - gamma) a + gamma a_1
//     (1 - alpha_m) a_1 + alpha_m a = (1 - alpha_f) A_1 + alpha_f A
//
// Source: Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185; Hilber, Hughes, Taylor 1977; Chung, Hulbert 1993.
#include "testing/kit/integrators/stability_theory.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include "plugin/describe.hpp"

namespace trammel::kit {

namespace {

struct Weights {
  double alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;
};

double radius_of(const Weights& w, double Omega) {
  const double K = Omega * Omega;
  // a_1 (1 - alpha_m) = -K (1 - alpha_f) x_1 - K alpha_f x - alpha_m a, x_1 = p . (x, v, a) + beta a_1
  const double left = 1 - w.alpha_m + K * (1 - w.alpha_f) * w.beta;
  const Eigen::RowVector3d p(1, 1, 0.5 - w.beta);
  const Eigen::RowVector3d a1 = (-K * (1 - w.alpha_f) * p - Eigen::RowVector3d(K * w.alpha_f, 0, w.alpha_m)) / left;
  Eigen::Matrix3d A;
  A.row(0) = p + w.beta * a1;
  A.row(1) = Eigen::RowVector3d(0, 1, 1 - w.gamma) + w.gamma * a1;
  A.row(2) = a1;
  return Eigen::EigenSolver<Eigen::Matrix3d>(A, false).eigenvalues().cwiseAbs().maxCoeff();
}

std::optional<double> number(const Component& c, const Declaration& d, const std::string& name) {
  for (const Parameter& p : d.parameters)
    if (p.name == name)
      if (const ParameterValue value = p.get(c); const double* x = std::get_if<double>(&value)) return *x;
  return {};
}

std::optional<Weights> weights_of(const Component& c, const Declaration& d) {
  const auto alpha = number(c, d, "alpha"), rho = number(c, d, "rho_inf"), gamma = number(c, d, "gamma");
  if (d.name.find("hht") != d.name.npos && alpha)
    return Weights{0, -*alpha, (1 - *alpha) * (1 - *alpha) / 4, 0.5 - *alpha};
  if (rho) {
    const double m = (2 * *rho - 1) / (*rho + 1), f = *rho / (*rho + 1), g = 0.5 + f - m;
    return Weights{m, f, (g + 0.5) * (g + 0.5) / 4, g};
  }
  if (const auto beta = number(c, d, "beta"); beta && gamma) return Weights{0, 0, *beta, *gamma};
  return {};
}

double runge_kutta_radius(int order, double Omega) {
  std::complex<double> term = 1, sum = 1;
  for (int k = 1; k <= order; ++k) sum += term *= std::complex<double>(0, Omega) / double(k);
  return std::abs(sum);
}

}  // namespace

std::optional<StabilityTheory> stability_theory(const Subject& s) {
  const auto component = s.make();
  const auto traits = dynamic_cast<const Integrator&>(*component).traits();
  if (const auto weights = traits.implicit ? weights_of(*component, s.declaration()) : std::nullopt)
    return StabilityTheory{[w = *weights](double Omega) { return radius_of(w, Omega); },
                           "the amplification matrix of the alpha methods"};
  if (!traits.implicit && traits.steps == 1 && traits.order <= 4)
    return StabilityTheory{[order = traits.order](double Omega) { return runge_kutta_radius(order, Omega); },
                           "|sum of (i omega h)^k/k!| of an explicit method of p stages and order p"};
  return {};
}

}  // namespace trammel::kit
