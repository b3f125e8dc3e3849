// The classical Runge-Kutta method of fourth order, for the first-order form of RungeKutta with Baumgarte's
// stabilisation.
//
//     k_1 = F(t, y), k_2 = F(t + h/2, y + h/2 k_1), k_3 = F(t + h/2, y + h/2 k_2), k_4 = F(t + h, y + h k_3)
//     y_{n+1} = y_n + h/6 (k_1 + 2 k_2 + 2 k_3 + k_4),       y = (q, v)
//
// Error estimate: with k_5 = F(t + h, y_{n+1}) instead of k_4 the formula is of third order; the difference h/6 (k_4 -
// k_5) is O(h^4). Kutta, Z. Math. Phys. 46, 435-453 (1901).
#include <trammel/plugin.hpp>
#include <trammel/row_parameters.hpp>
#include <trammel/methods/runge_kutta.hpp>

namespace {

using namespace trammel;

constexpr double c[] = {0, 0.5, 0.5, 1};
constexpr double a[] = {0.5, 0, 0.5, 0, 0, 1};
constexpr double b[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
constexpr double less_embedded[] = {0, 0, 0, 1.0 / 6, -1.0 / 6};

class RungeKutta4 final : public Integrator, public ErrorEstimate {
 public:
  double delta = 0, epsilon = 0;
  RungeKutta::Rows rows = RungeKutta::Rows::baumgarte;

  void prepare(const World&) override { method_.baumgarte = {delta, epsilon}, method_.rows = rows; }
  Traits traits() const override {
    return {.order = 4, .holds_position = method_.projects(), .holds_velocity = method_.projects()};
  }

  void restart(System& s, const State& now) override { method_.begin(s, now, slope_); }

  Outcome step(System& s, const State& now, double h, State& next) override {
    return method_.step(s, now, slope_, h, next);
  }

  // The slope at the step's end is the first one of the next.
  void accept(System& s, const State& /*now*/, const State& next) override {
    s.rate(next.q, next.v, slope_.q);
    slope_.v = next.a;
    slope_.lambda = next.lambda;
  }

  double error(System& s, const State& now, const State& next, const Tolerance& tolerance) override {
    return method_.error(now, next, [&](RungeKutta::Part part) {
      method_.combine(less_embedded, 5, e_, e_v_);
      return method_.norm(s, now, next, e_, e_v_, part, tolerance);
    });
  }
  int error_order() const override { return 4; }

  void archive(Archive& archive) override {
    method_.archive(archive);
    archive("now_slope_q", slope_.q);
    archive("now_slope_v", slope_.v);
    archive("now_slope_lambda", slope_.lambda);
  }

 private:
  RungeKutta method_{{4, c, a, b}};
  Slope slope_;  // at the last accepted point
  Vec e_, e_v_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::row_parameters(
    trammel::integrator<RungeKutta4>("runge_kutta_4", "the classical Runge-Kutta method of fourth order")
        .source("Kutta 1901, Z. Math. Phys. 46, 435-453; Baumgarte 1972, Comput. Methods Appl. Mech. Eng. 1, 1-16")))
