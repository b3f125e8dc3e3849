// The classical Runge-Kutta method of fourth order, for the first-order form of RungeKutta with Baumgarte's
// stabilisation.
//
//     k_1 = F(t, y), k_2 = F(t + h/2, y + h/2 k_1), k_3 = F(t + h/2, y + h/2 k_2), k_4 = F(t + h, y + h k_3)
//     y_{n+1} = y_n + h/6 (k_1 + 2 k_2 + 2 k_3 + k_4),       y = (q, v)
//
// Error estimate: with k_5 = F(t + h, y_{n+1}) in place of k_4 the formula is of third order; the difference h/6 (k_4 -
// k_5) shrinks with h^4. Kutta, Z. Math. Phys. 46, 435-453 (1901).
#include <trammel/methods/runge_kutta_integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

constexpr double c[] = {0, 0.5, 0.5, 1};
constexpr double a[] = {0.5, 0, 0.5, 0, 0, 1};
constexpr double b[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
constexpr double less_embedded[] = {0, 0, 0, 1.0 / 6, -1.0 / 6};

struct RungeKutta4 {
  static constexpr Tableau tableau{4, c, a, b};
  static constexpr int order = 4, error_order = 4;
  static constexpr Stabilisation baumgarte{0, 0};

  template <class Norm>
  static double error(Norm&& norm) {
    return norm(less_embedded);
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::runge_kutta_integrator<RungeKutta4>("runge_kutta_4", "the classical Runge-Kutta method of fourth order")
        .source("Kutta 1901, Z. Math. Phys. 46, 435-453; Baumgarte 1972, Comput. Methods Appl. Mech. Eng. 1, 1-16"))
