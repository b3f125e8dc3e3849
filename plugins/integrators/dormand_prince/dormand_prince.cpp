// The embedded Runge-Kutta pair 5(4) of Dormand and Prince, for the first-order form of RungeKutta with Baumgarte's
// stabilisation. It has six stages and a seventh at the step's end, which is the first of the next step; the result is
// of fifth order. Dense output of fourth order after Hairer. Dormand, Prince, J. Comput. Appl. Math. 6(1), 19-26
// (1980); Hairer, Norsett, Wanner, Solving ODEs I, II.5 and II.6.
#include <trammel/plugin.hpp>
#include <trammel/row_parameters.hpp>
#include <trammel/methods/runge_kutta.hpp>

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
constexpr double less_embedded[] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
constexpr double dense[] = {
    -12715105075.0 / 11282082432, 0, 87487479700.0 / 32700410799, -10690763975.0 / 1880347072,
    701980252875.0 / 199316789632, -1453857185.0 / 822651844, 69997945.0 / 29380423};
// clang-format on

class DormandPrince final : public Integrator, public ErrorEstimate, public DenseOutput {
 public:
  double delta = 10, epsilon = 10;
  RungeKutta::Rows rows = RungeKutta::Rows::baumgarte;

  void prepare(const World&) override { method_.baumgarte = {delta, epsilon}, method_.rows = rows; }
  Traits traits() const override {
    return {.order = 5, .holds_position = method_.projects(), .holds_velocity = method_.projects()};
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
      method_.combine(less_embedded, 7, e_, e_v_);
      return method_.norm(s, now, next, e_, e_v_, part, tolerance);
    });
  }
  int error_order() const override { return 5; }

  void interpolate(System& s, const State& now, const State& next, double theta, State& at) override {
    if (method_.recall(s, now, next))
      method_.interpolate(s, now, next, theta, {dense}, at);
    else
      method_.step_inside(s, now, next, theta, at);
  }

  void archive(Archive& archive) override {
    method_.archive(archive);
    archive("now_slope_q", slope_.q);
    archive("now_slope_v", slope_.v);
    archive("now_slope_lambda", slope_.lambda);
  }

 private:
  RungeKutta method_{{6, c, a, b}};
  Slope slope_;  // at the last accepted point
  Vec e_, e_v_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::row_parameters(
    trammel::integrator<DormandPrince>("dormand_prince", "Dormand-Prince 5(4): error estimate and dense output")
        .source("Dormand, Prince 1980, J. Comput. Appl. Math. 6(1), 19-26; Baumgarte 1972, CMAME 1, 1-16")))
