// The embedded Runge-Kutta pair 5(4) of Dormand and Prince, on the first-order form of RungeKutta with Baumgarte's
// stabilisation: six stages, a seventh at the step's end that is the first of the next step, the fifth-order result
// kept. Dense output of fourth order after Hairer. Dormand, Prince, J. Comput. Appl. Math. 6(1), 19-26 (1980); Hairer,
// Norsett, Wanner, Solving ODEs I, II.5 and II.6.
#include <trammel/methods/runge_kutta_integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// clang-format off
constexpr double c[] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1};
constexpr double a[] = {
    1.0 / 5,
    3.0 / 40,         9.0 / 40,
    44.0 / 45,       -56.0 / 15,       32.0 / 9,
    19372.0 / 6561,  -25360.0 / 2187,  64448.0 / 6561,  -212.0 / 729,
    9017.0 / 3168,   -355.0 / 33,      46732.0 / 5247,   49.0 / 176,  -5103.0 / 18656};
constexpr double b[] = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
// b minus the weights of the embedded fourth-order method.
constexpr double less_embedded[] = {
    71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
constexpr double dense[] = {
    -12715105075.0 / 11282082432, 0, 87487479700.0 / 32700410799, -10690763975.0 / 1880347072,
    701980252875.0 / 199316789632, -1453857185.0 / 822651844, 69997945.0 / 29380423};
// clang-format on

struct DormandPrince {
  static constexpr Tableau tableau{6, c, a, b};
  static constexpr int order = 5, error_order = 5;
  static constexpr Stabilisation baumgarte{10, 10};

  template <class Norm>
  static double error(Norm&& norm) {
    return norm(less_embedded);
  }
  static bool interpolate(RungeKutta& method, System& s, const State& now, const State& next, double theta, State& at) {
    method.interpolate(s, now, next, theta, {dense}, at);
    return true;
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::runge_kutta_integrator<DormandPrince>("dormand_prince",
                                                              "Dormand-Prince 5(4): error estimate and dense output")
                   .source("Dormand, Prince 1980, J. Comput. Appl. Math. 6(1), 19-26; Baumgarte 1972, CMAME 1, 1-16"))
