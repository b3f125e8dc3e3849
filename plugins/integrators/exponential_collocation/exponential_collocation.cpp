// Collocation at Lobatto's five points by variation of constants: the system's small oscillations (small_oscillations.hpp),
// linearised now and then, are followed exactly, and what is left of the acceleration is a polynomial in time.
//
//     x' = v,  v' = -Phi omega^2 Psi x + n,   n = a + Phi omega^2 Psi x       x: increment since the step's start
//     eta_i = cos(omega t_i) eta_0 + sum_j (int_0^{t_i} cos(omega (t_i - tau)) l_j(tau) dtau) Psi n_j     eta = Psi v, l_j Lagrange's
//
// and x likewise by sin/omega; where no mode is, omega = 0. On manifolds q' = N(q) v: q_i = q_0 + N(q_0) x_i + the integral of
// r = (N(q) - N(q_0)) v, a polynomial too. n_j and r_j are guessed from the last step's polynomials and put right by sweeps
// over the points; a sweep's error shrinks by h times what n depends on v.
//
// Steps are as long as n allows, not as the fastest mode does. With all omega = 0 this is collocation at Lobatto's points for
// x'' = a, of order 8, iterated.
//
// Hochbruck, Ostermann, Exponential integrators, Acta Numerica 19, 209-286 (2010); Wang, Iserles, Wu, Arbitrary-order
// trigonometric Fourier collocation methods, Found. Comput. Math. 16, 151-181 (2016).
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <trammel/error_norm.hpp>
#include <trammel/oscillating_steps.hpp>
#include <trammel/plugin.hpp>
#include <trammel/row_parameters.hpp>
#include <trammel/runge_kutta.hpp>

#include "collocation_weights.hpp"
#include "small_oscillations.hpp"

namespace {

using namespace trammel;
using namespace trammel::collocation;

class ExponentialCollocation final : public Integrator, public ErrorEstimate, public OscillatingSteps {
 public:
  double delta = 10, epsilon = 10;
  int sweeps = 3;
  RungeKutta::Rows rows = RungeKutta::Rows::baumgarte;

  void prepare(const World&) override { field_.baumgarte = {delta, epsilon}, field_.rows = rows; }
  Traits traits() const override {
    return {.order = std::min(points + sweeps, 2 * last),
            .steps = 2,
            .holds_position = field_.projects(),
            .holds_velocity = field_.projects()};
  }

  void restart(System& s, const State& now) override {
    if (s.sizes().nv > most_coordinates)
      throw std::runtime_error(
          "exponential_collocation solves a dense eigenproblem of all coordinates at every event: take dop853 "
          "or generalized_alpha for more than 1000");
    modes_.linearise(s, now);
    linearise_ = false;
    steps_ = 0;
    past_h_ = trial_h_ = weights_h_ = 0;
  }

  Outcome step(System& s, const State& now, double h, State& next) override {
    if (linearise_) restart(s, now);
    return field_.within_step(s, now, [&] { return collocate(s, now, h, next); });
  }

  void accept(System& s, const State& now, const State& next) override {
    if (!recall(s, now, next)) {
      past_h_ = 0;
      return;
    }
    past_h_ = trial_h_;
    past_n_ = n_, past_v_ = v_, past_q_dot_ = q_dot_;
    past_n_.col(last) = end_n_, past_v_.col(last) = end_v_, past_q_dot_.col(last) = slope_end_;
    // Perhaps as modes have turned; a linearisation costs about ten steps. At the next step: others may still look into this one.
    constexpr double slow = 0.1;
    constexpr int pays_after = 10;
    linearise_ = ++steps_ >= pays_after && shrinks_ > slow;
  }

  double error(System& s, const State& now, const State& next, const Tolerance& tolerance) override {
    if (!recall(s, now, next)) return std::numeric_limits<double>::infinity();
    if (shrinks_ > diverges) return std::numeric_limits<double>::infinity();
    const double sweep = shrinks_ * error_norm(swept_x_, swept_v_, now, next, tolerance);
    return std::max(without_middle_norm(s, now, next, tolerance), sweep);
  }
  int error_order() const override { return points; }

  void interpolate(System& s, const State& now, const State& next, double theta, State& at) override {
    if (!recall(s, now, next)) {
      at = next;
      return;
    }
    weigh(modes_.omega(), theta, trial_h_, inside_);
    solution_at(now, inside_, x_, at.v);
    configuration_at(s, now, inside_, x_, at.q);
    at.t = now.t + inside_.t;
  }

  double swing() const override { return modes_.count() > 0 ? modes_.omega().maxCoeff() : 0; }

  void archive(Archive& archive) override {
    modes_.archive(archive);
    archive("steps", steps_);
    archive("linearise", linearise_);
    archive("past_h", past_h_);
    const auto points_of = [&](const char* name, Mat& m) {
      for (int j = 0; j < points && past_h_ > 0; ++j) {
        Vec column = m.cols() == points ? Vec(m.col(j)) : Vec();
        archive(name + std::to_string(j), column);
        m.conservativeResize(column.size(), points);
        m.col(j) = column;
      }
    };
    points_of("past_n_", past_n_), points_of("past_v_", past_v_), points_of("past_q_dot_", past_q_dot_);
  }

 private:
  Outcome collocate(System& s, const State& now, double h, State& next) {
    resize(s);
    if (h != weights_h_)
      for (int i = 1; i < points; ++i) weigh(modes_.omega(), c[i], h, weights_[i]);
    weights_h_ = h;
    trial_h_ = h;
    const bool guessed = guess(s, now, h);
    shrinks_ = 0, last_change_ = std::numeric_limits<double>::infinity();
    // From constants each sweep wins one order, until nothing changes.
    const int most = guessed ? sweeps : std::max(sweeps, 2 * last - 1);
    for (int i = 0; i < most && !settled(); ++i)
      if (!sweep(s, now)) return Outcome::reject(RungeKutta::diverged);

    swept_v_ = v_.col(last), swept_x_ = x_;
    solution_at(now, weights_[last], x_, next.v);
    configuration_at(s, now, weights_[last], x_, next.q);
    next.t = now.t + h;
    swept_v_ -= next.v, swept_x_ -= x_;
    if (!field_.evaluate(s, next.t, next.q, next.v, slope_)) return Outcome::reject(RungeKutta::diverged);
    end_n_ = slope_.v, end_v_ = next.v, slope_end_ = slope_.q;
    modes_.add_acceleration(1, x_, amplitude_, end_n_);
    const double change = (n_.col(last) - end_n_).lpNorm<Eigen::Infinity>();
    shrinks_ = change == 0 ? 0 : change / last_change_;
    if (shrinks_ > 1 && !settled())
      return Outcome::reject("the sweeps of the step do not converge: take a shorter step");
    if (field_.projects()) field_.taken_at(next.q, next.v);
    next.a = slope_.v, next.lambda = slope_.lambda;
    return Outcome::accept();
  }

  // To round-off of what n is the difference of.
  bool settled() const { return last_change_ <= 1e-12 * n_.col(last).lpNorm<Eigen::Infinity>(); }

  bool sweep(System& s, const State& now) {
    for (int i = 1; i < points; ++i) {
      solution_at(now, weights_[i], x_, v_i_);
      configuration_at(s, now, weights_[i], x_, q_i_);
      if (i == last) end_n_ = n_.col(last);
      if (!field_.evaluate(s, now.t + weights_[i].t, q_i_, v_i_, slope_)) return false;
      take_slope(s, now, i, v_i_);
    }
    last_change_ = (n_.col(last) - end_n_).lpNorm<Eigen::Infinity>();
    return true;
  }

  // n, v, q' and r at point i from the slope there; x_ is the increment.
  void take_slope(System& s, const State& now, int i, const Vec& v) {
    n_.col(i) = slope_.v;
    if (i > 0) modes_.add_acceleration(1, x_, amplitude_, n_.col(i));
    psi_n_.col(i).noalias() = modes_.amplitudes() * n_.col(i);
    v_.col(i) = v, q_dot_.col(i) = slope_.q;
    s.rate(now.q, v, rate_);
    r_.col(i) = slope_.q - rate_;
  }

  // n and r at the step's points; false: constant, there is no last step or it was much shorter.
  bool guess(System& s, const State& now, double h) {
    constexpr double reach = 2.5;
    slope_.v = now.a;
    s.rate(now.q, now.v, slope_.q);
    take_slope(s, now, 0, now.v);
    const bool past = past_h_ > 0 && h <= reach * past_h_;
    psi_v_.noalias() = modes_.amplitudes() * now.v;
    for (int i = 1; i < points; ++i) {
      if (past) {
        ahead_ = lagrange(1 + c[i] * h / past_h_);
        n_.col(i).noalias() = past_n_ * ahead_;
        n_.col(i) += now.a - past_n_.col(last);
        v_i_.noalias() = past_v_ * ahead_;
        s.rate(now.q, v_i_, rate_);
        r_.col(i).noalias() = past_q_dot_ * ahead_;
        r_.col(i) -= rate_;
      } else {
        n_.col(i) = now.a;
        r_.col(i).setZero();
      }
      psi_n_.col(i).noalias() = modes_.amplitudes() * n_.col(i);
    }
    return past;
  }
  void solution_at(const State& now, const Weights& w, Vec& x, Vec& v) {
    v = now.v;
    v.noalias() += n_ * w.v;
    amplitude_ = w.v_0.cwiseProduct(psi_v_) + w.v_n.cwiseProduct(psi_n_).rowwise().sum();
    v.noalias() += modes_.shapes() * amplitude_;
    x = w.t * now.v;
    x.noalias() += n_ * w.x;
    amplitude_ = w.x_0.cwiseProduct(psi_v_) + w.x_n.cwiseProduct(psi_n_).rowwise().sum();
    x.noalias() += modes_.shapes() * amplitude_;
  }

  void configuration_at(const System& s, const State& now, const Weights& w, const Vec& x, Vec& q) {
    s.rate(now.q, x, rate_);
    q = now.q + rate_;
    q.noalias() += r_ * w.v;
    s.normalise(q);
  }

  // The result less that of the polynomials through the other four points, O(h^5): the error of steps that hold many swings, and
  // more than that of others.
  double without_middle_norm(System& s, const State& now, const State& next, const Tolerance& tolerance) {
    Points difference;
    for (int j = 0; j < points; ++j) {
      difference[j] = j == middle ? 1 : -1;
      for (int m = 0; m < points; ++m)
        if (j != middle && m != j && m != middle) difference[j] *= (c[middle] - c[m]) / (c[j] - c[m]);
    }
    const Weights& w = weights_[last];
    beyond_.noalias() = n_ * difference;
    modal_.noalias() = modes_.amplitudes() * beyond_;
    e_v_ = w.v[middle] * beyond_;
    amplitude_ = w.v_n.col(middle).cwiseProduct(modal_);
    e_v_.noalias() += modes_.shapes() * amplitude_;
    e_x_ = w.x[middle] * beyond_;
    amplitude_ = w.x_n.col(middle).cwiseProduct(modal_);
    e_x_.noalias() += modes_.shapes() * amplitude_;
    s.rate(now.q, e_x_, e_);
    beyond_.noalias() = r_ * difference;
    e_ += w.v[middle] * beyond_;
    error_increment(s, next.q, e_, embedded_, e_q_);
    return error_norm(e_q_, e_v_, now, next, tolerance);
  }

  // Makes the step from `now` to `next` the last one: repeats it if another was tried since.
  bool recall(System& s, const State& now, const State& next) {
    const double h = next.t - now.t;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(now.t), std::abs(next.t));
    if (trial_h_ > 0 && std::abs(h - trial_h_) <= rounding && now.a == n_.col(0)) return true;
    return step(s, now, h, repeated_).accepted();
  }

  void resize(const System& s) {
    const auto [nq, nv, nc] = s.sizes();
    n_.resize(nv, points), v_.resize(nv, points), q_dot_.resize(nq, points), r_.resize(nq, points);
    psi_n_.resize(modes_.count(), points);
  }

  static constexpr int most_coordinates = 1000;
  static constexpr double diverges = 0.5;  // sweeps whose changes shrink by less
  static constexpr double none = 0;
  RungeKutta field_{{1, &none, &none, &none}};  // of whose steps none is made
  SmallOscillations modes_;
  int steps_ = 0;           // since the last linearisation
  bool linearise_ = false;  // at the next step
  // At the points of the step accepted last, whose length is past_h_; 0: forgotten.
  double past_h_ = 0;
  Mat past_n_, past_v_, past_q_dot_;
  // Of the last trial.
  double trial_h_ = 0;
  Mat n_, v_, q_dot_, r_, psi_n_;
  Vec psi_v_, swept_x_, swept_v_;
  Vec end_n_, end_v_, slope_end_;         // at the step's end, of its result
  double last_change_ = 0, shrinks_ = 0;  // of n at the end: by the last sweep, and how much less after it
  double weights_h_ = 0;
  Weights weights_[points], inside_;
  Slope slope_;
  Points ahead_;
  Vec beyond_, modal_, x_, v_i_, q_i_, rate_, amplitude_, e_, e_x_, e_v_, e_q_, embedded_;
  State repeated_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::row_parameters(
    trammel::integrator<ExponentialCollocation>("exponential_collocation",
                                                "Exponential Lobatto collocation: small oscillations exactly, steps by "
                                                "the rest; for flexible bodies whose fast modes only ring")
        .source("Hochbruck, Ostermann 2010, Acta Numerica 19, 209-286; Wang, Iserles, Wu 2016, Found. Comput. Math. "
                "16, 151-181")
        .parameter("sweeps", &ExponentialCollocation::sweeps,
                   {.min = 1,
                    .max = 20,
                    .doc = "of a step over its four points beyond the start: order 8 with 3; 1 (order 6) for forces "
                           "that hardly depend on velocities"})))
