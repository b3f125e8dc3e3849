// Collocation at Lobatto's seven points by variation of constants. The system's small oscillations
// (small_oscillations.hpp), linearised from time to time, are integrated exactly; the remaining acceleration is
// approximated by a polynomial in time.
//
//     x = Phi xi, xi' = eta, eta' = -omega^2 xi + nu,   nu = Psi a + omega^2 xi    x: increment, v = Phi eta
//     eta_i = cos(omega t_i) eta_0 + sum_j (int_0^{t_i} cos(omega (t_i - tau)) l_j(tau) dtau) nu_j      l_j: Lagrange's
//
// and xi likewise with sin/omega; slow modes have omega = 0. On manifolds q' = N(q) v: q_i = q_0 + N(q_0) x_i + the
// integral of r = (N(q) - N(q_0)) v, also a polynomial. The polynomials of the last step predict nu_j and r_j; sweeps
// over the points correct them. A sweep reduces the error by h times the derivative of nu by eta.
//
// The step size is limited by nu, not by the fastest mode. With all omega = 0 this is iterated collocation at Lobatto's
// points for x'' = a, of order 12.
//
// Hochbruck, Ostermann, Exponential integrators, Acta Numerica 19, 209-286 (2010); Wang, Iserles, Wu, Arbitrary-order
// trigonometric Fourier collocation methods, Found. Comput. Math. 16, 151-181 (2016).
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <trammel/methods/error_norm.hpp>
#include <trammel/methods/oscillating_steps.hpp>
#include <trammel/methods/runge_kutta.hpp>
#include <trammel/plugin.hpp>
#include <trammel/row_parameters.hpp>

#include "collocation_weights.hpp"
#include "small_oscillations.hpp"
#include "sweep_convergence.hpp"

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
    past_h_ = trial_h_ = 0;
    convergence_.distrust();
    field_.forget();
    const auto [nq, nv, nc] = s.sizes();
    if (nv != modes_.omega().size() || nc != rows_) linearise(s, now);
    s.move_to(now.t, now.q, now.v);
    round_off_of_forces_ = nv > 0 ? eps * (modes_.shapes().transpose() * s.f()).lpNorm<Eigen::Infinity>() : 0;
  }

  Outcome step(System& s, const State& now, double h, State& next) override {
    if (linearise_) linearise(s, now);
    return field_.within_step(s, now, [&] { return collocate(s, now, h, next); });
  }

  void accept(System& s, const State& now, const State& next) override {
    if (!recall(s, now, next)) {
      past_h_ = 0;
      return;
    }
    past_h_ = trial_h_;
    past_nu_ = nu_, past_v_ = v_, past_q_dot_ = q_dot_;
    past_nu_.col(last) = end_nu_, past_v_.col(last) = end_v_, past_q_dot_.col(last) = slope_end_;
    convergence_.accept();
    // Slow convergence may mean that the modes have changed. The next step linearises, because dense output of this one
    // may still be needed.
    linearise_ = ++steps_ >= cost_of_linearisation && convergence_.slow(sweeps);
  }

  double error(System& s, const State& now, const State& next, const Tolerance& tolerance) override {
    if (!recall(s, now, next)) return std::numeric_limits<double>::infinity();
    // The growth of errors counts only near its limit, 1. It is scaled to the order of the other errors, so that the
    // step is reduced by the right factor.
    const double growth = convergence_.growth(sweeps);
    const double growing = growth > growth_that_counts ? std::pow(growth, double(points) / sweeps) : 0;
    const double sweep = convergence_.contraction() * last_sweep_norm(s, now, next, tolerance);
    const double collocated =
        field_.error(now, next, [&](Part part) { return without_middle_norm(s, now, next, tolerance, part); });
    return std::max({collocated, sweep, growing});
  }
  int error_order() const override { return points; }

  void interpolate(System& s, const State& now, const State& next, double theta, State& at) override {
    if (!recall(s, now, next)) return set_unknown(now, at);
    if (theta != inside_at_ || trial_h_ != inside_h_) weigh(modes_.omega(), theta, trial_h_, inside_);
    inside_at_ = theta, inside_h_ = trial_h_;
    solution_at(s, now, inside_, at.q, at.v);
    at.t = now.t + inside_.t;
  }

  int quadrature_points() const override { return points; }
  double evaluated(System& s, const State& now, const State& next, int i, State& at) override {
    const bool known = recall(s, now, next);
    if (i == 0 || i == last) {
      at = i == 0 ? now : next;
    } else if (!known) {
      set_unknown(now, at);
    } else {
      at.t = now.t + weights_[i].t;
      at.q = q_.col(i), at.v = v_.col(i), at.lambda = lambda_.col(i);
    }
    return weights_[last].integral[i];
  }

  double swing() const override { return modes_.omega().size() > 0 ? modes_.omega().maxCoeff() : 0; }

  void archive(Archive& archive) override {
    modes_.archive(archive);
    archive("rows", rows_);
    archive("steps", steps_);
    archive("linearise", linearise_);
    archive("round_off_of_forces", round_off_of_forces_);
    convergence_.archive(archive);
    field_.archive(archive);
    archive("past_h", past_h_);
    const auto points_of = [&](const char* name, Mat& m) {
      for (int j = 0; j < points && past_h_ > 0; ++j) {
        Vec column = m.cols() == points ? Vec(m.col(j)) : Vec();
        archive(name + std::to_string(j), column);
        if (j > 0 && column.size() != m.rows()) throw std::length_error(name);
        m.conservativeResize(column.size(), points);
        m.col(j) = column;
      }
    };
    points_of("past_nu_v_", past_nu_), points_of("past_v_", past_v_), points_of("past_rate_q_", past_q_dot_);
  }

 private:
  using Part = RungeKutta::Part;

  void linearise(System& s, const State& now) {
    const auto [nq, nv, nc] = s.sizes();
    if (nv > most_coordinates)
      throw std::runtime_error(
          "exponential_collocation solves a dense eigenproblem of all coordinates: take dop853 or generalized_alpha "
          "for more than 1000");
    modes_.linearise(s, now);
    rows_ = nc;
    linearise_ = false;
    steps_ = 0;
    convergence_.distrust();
    past_h_ = trial_h_ = weights_h_ = inside_h_ = 0;
  }

  Outcome collocate(System& s, const State& now, double h, State& next) {
    resize(s);
    if (h != weights_h_)
      for (int i = 1; i < points; ++i) weigh(modes_.omega(), c[i], h, weights_[i]);
    weights_h_ = h;
    trial_h_ = h;
    const bool guessed = guess(s, now, h);
    const auto [rounding, unseen] = round_off(now, h);
    convergence_.begin(h, guessed ? h / past_h_ : 0, rounding, unseen);
    // Starting from constants, each sweep raises the order by one, until nothing changes.
    const int most = guessed ? std::max(sweeps, convergence_.known() ? 1 : 2) : std::max(sweeps, 2 * last - 1);
    for (int i = 0; i < most && !convergence_.settled(); ++i)
      if (!sweep(s, now)) return Outcome::reject(RungeKutta::diverged);
    if (convergence_.diverges(sweeps))
      return Outcome::reject("the sweeps of the step do not converge: take a shorter step, or more sweeps");

    solution_at(s, now, weights_[last], next.q, next.v);
    next.t = now.t + h;
    if (rows_ == 0)
      take_end(s, next);
    else if (!evaluate_end(s, next))
      return Outcome::reject(RungeKutta::diverged);
    return Outcome::accept();
  }

  // The multipliers must belong to the step's end.
  [[nodiscard]] bool evaluate_end(System& s, State& next) {
    if (!field_.evaluate(s, next.t, next.q, next.v, slope_)) return false;
    end_nu_ = rest(), end_v_ = next.v, slope_end_ = slope_.q;
    if (field_.projects()) field_.taken_at(next.q, next.v);
    next.a = slope_.v, next.lambda = slope_.lambda;
    return true;
  }

  // Without rows the acceleration follows from nu of the last sweep at the increment Phi xi_, which saves one
  // evaluation of seven.
  void take_end(System& s, State& next) {
    end_nu_ = nu_.col(last), end_v_ = next.v;
    s.rate(next.q, next.v, slope_end_);
    rest_ = end_nu_ - modes_.omega_2().cwiseProduct(xi_);
    next.a.noalias() = modes_.shapes() * rest_;
    next.lambda.resize(0);
  }

  // Round-off of nu, and its effect on q in a step. Elastic forces are differences of terms as large as omega^2 q, and
  // the forces of rows balance applied ones where a body rests.
  std::pair<double, double> round_off(const State& now, double h) {
    if (now.q.size() != now.v.size())
      return {round_off_of_forces_,
              eps * modes_.amplitudes().lpNorm<Eigen::Infinity>() * now.q.lpNorm<Eigen::Infinity>() / (h * h)};
    rest_.noalias() = modes_.amplitudes() * now.q;
    return {std::max(eps * rest_.cwiseProduct(modes_.omega_2()).lpNorm<Eigen::Infinity>(), round_off_of_forces_),
            eps * rest_.lpNorm<Eigen::Infinity>() / (h * h)};
  }

  [[nodiscard]] bool sweep(System& s, const State& now) {
    swept_nu_ = nu_, swept_r_ = r_;
    swept_nu_.col(0).setZero();
    SweepConvergence::Change change{.whole = 0, .along_rows = 0};
    for (int i = 1; i < points; ++i) {
      solution_at(s, now, weights_[i], q_i_, v_i_);
      if (!field_.evaluate(s, now.t + weights_[i].t, q_i_, v_i_, slope_)) return false;
      take_slope(s, now, i, v_i_);
      q_.col(i) = q_i_, lambda_.col(i) = slope_.lambda;
      swept_nu_.col(i) = nu_.col(i) - swept_nu_.col(i);
      change.whole = std::max(change.whole, swept_nu_.col(i).lpNorm<Eigen::Infinity>());
      if (field_.projects() && rows_ > 0) put_along_rows(s, i);
      change.along_rows = std::max(change.along_rows, swept_nu_.col(i).lpNorm<Eigen::Infinity>());
    }
    swept_r_ = r_ - swept_r_;
    const double size =
        (nu_.col(last).cwiseAbs() + modes_.omega_2().cwiseProduct(xi_.cwiseAbs())).lpNorm<Eigen::Infinity>();
    convergence_.swept(change, size);
    return true;
  }

  // The change of nu_i by the sweep.
  void put_along_rows(System& s, int i) {
    e_v_.noalias() = modes_.shapes() * swept_nu_.col(i);
    field_.put_along_rows(s, e_v_);
    swept_nu_.col(i).noalias() = modes_.amplitudes() * e_v_;
  }

  // nu from the slope at the increment Phi xi.
  const Vec& rest() {
    rest_.noalias() = modes_.amplitudes() * slope_.v;
    rest_ += modes_.omega_2().cwiseProduct(xi_);
    return rest_;
  }

  // nu, v, q' and r at point i from the slope there; the increment is Phi xi_.
  void take_slope(System& s, const State& now, int i, const Vec& v) {
    nu_.col(i) = rest();
    v_.col(i) = v, q_dot_.col(i) = slope_.q;
    s.rate(now.q, v, rate_);
    r_.col(i) = slope_.q - rate_;
  }

  // Predicts nu and r at the step's points. False: constants, because there is no last step or it was much shorter.
  bool guess(System& s, const State& now, double h) {
    slope_.v = a_0_ = now.a;
    s.rate(now.q, now.v, slope_.q);
    xi_.setZero(now.v.size());
    take_slope(s, now, 0, now.v);
    eta_0_.noalias() = modes_.amplitudes() * now.v;
    const bool past = past_h_ > 0 && h <= longest_prediction * past_h_;
    if (past && ahead_by_ != h / past_h_) look_ahead(h / past_h_);
    for (int i = 1; i < points; ++i) {
      if (past) {
        rest_.noalias() = past_nu_ * ahead_.col(i);
        nu_.col(i) = rest_ + nu_.col(0) - past_nu_.col(last);
        v_i_.noalias() = past_v_ * ahead_.col(i);
        s.rate(now.q, v_i_, rate_);
        r_.col(i).noalias() = past_q_dot_ * ahead_.col(i);
        r_.col(i) -= rate_;
      } else {
        nu_.col(i) = nu_.col(0);
        r_.col(i).setZero();
      }
    }
    return past;
  }

  // Extrapolates the last step's polynomials to the points of a step that is `ratio` times as long.
  void look_ahead(double ratio) {
    for (int i = 1; i < points; ++i) ahead_.col(i) = lagrange(1 + c[i] * ratio);
    ahead_by_ = ratio;
  }

  // eta or xi by their weights, as one expression over all points to reduce the overhead of loops.
  void oscillate(const Vec& w_0, const Mat& w, Vec& sum) const {
    static_assert(points == 7);
    const auto part = [&](int j) { return w.col(j).cwiseProduct(nu_.col(j)); };
    sum = w_0.cwiseProduct(eta_0_) + part(0) + part(1) + part(2) + part(3) + part(4) + part(5) + part(6);
  }

  // The same and the increment x_ = Phi xi_.
  void solution_at(const System& s, const State& now, const Weights& w, Vec& q, Vec& v) {
    oscillate(w.v_0, w.v, eta_);
    oscillate(w.x_0, w.x, xi_);
    v = now.v;
    v.noalias() += modes_.shapes() * eta_;
    x_.noalias() = modes_.shapes() * xi_;
    s.rate(now.q, x_, rate_);
    q = now.q + rate_;
    q.noalias() += r_ * w.integral;
    s.normalise(q);
  }

  // The result minus that of the polynomials through the other six points, O(h^7). It estimates the error of steps with
  // many oscillations and overestimates that of others.
  double without_middle_norm(System& s, const State& now, const State& next, const Tolerance& tolerance, Part part) {
    const Weights& w = weights_[last];
    rest_.noalias() = nu_ * beyond_others();
    eta_ = w.v.col(middle).cwiseProduct(rest_);
    xi_ = w.x.col(middle).cwiseProduct(rest_);
    beyond_.noalias() = r_ * beyond_others();
    beyond_ *= w.integral[middle];
    return norm(s, now, next, tolerance, part);
  }

  // The change of the result by the last sweep.
  double last_sweep_norm(System& s, const State& now, const State& next, const Tolerance& tolerance) {
    const Weights& w = weights_[last];
    eta_ = w.v.cwiseProduct(swept_nu_).rowwise().sum();
    xi_ = w.x.cwiseProduct(swept_nu_).rowwise().sum();
    beyond_.noalias() = swept_r_ * w.integral;
    return norm(s, now, next, tolerance, Part::whole);
  }

  // The norm of an error: Phi eta_ of the velocity, Phi xi_ of the increment, beyond_ of the rest of q.
  double norm(System& s, const State& now, const State& next, const Tolerance& tolerance, Part part) {
    e_v_.noalias() = modes_.shapes() * eta_;
    x_.noalias() = modes_.shapes() * xi_;
    s.rate(now.q, x_, e_);
    e_ += beyond_;
    return field_.norm(s, now, next, e_, e_v_, part, tolerance);
  }

  static void set_unknown(const State& now, State& at) {
    at = now;
    at.q.setConstant(std::numeric_limits<double>::quiet_NaN());
    at.v.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  // Makes the step from `now` to `next` the last step: repeats it if another one was tried since. False: it was
  // rejected.
  [[nodiscard]] bool recall(System& s, const State& now, const State& next) {
    const double h = next.t - now.t;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(now.t), std::abs(next.t));
    if (trial_h_ > 0 && std::abs(h - trial_h_) <= rounding && now.a == a_0_) return true;
    return step(s, now, h, repeated_).accepted();
  }

  void resize(const System& s) {
    const auto [nq, nv, nc] = s.sizes();
    nu_.resize(nv, points), v_.resize(nv, points), q_dot_.resize(nq, points), r_.resize(nq, points);
    q_.resize(nq, points), lambda_.resize(nc, points);
  }

  static constexpr int most_coordinates = 1000;
  static constexpr int cost_of_linearisation = 10;    // in steps
  static constexpr double growth_that_counts = 0.25;  // SweepConvergence::growth; the limit is 1
  static constexpr double longest_prediction = 2.5;   // step, in lengths of the last one
  static constexpr double none = 0, eps = std::numeric_limits<double>::epsilon();
  RungeKutta field_{{1, &none, &none, &none}};  // only its slopes are used
  SmallOscillations modes_;
  int rows_ = 0;                    // at the last linearisation
  int steps_ = 0;                   // since then
  bool linearise_ = false;          // at the next step
  double round_off_of_forces_ = 0;  // of nu, at the last restart
  SweepConvergence convergence_;
  // At the points of the last accepted step of size past_h_; 0: none.
  double past_h_ = 0;
  Mat past_nu_, past_v_, past_q_dot_;
  // Data of the last trial.
  double trial_h_ = 0;
  Mat nu_, v_, q_dot_, r_, swept_nu_, swept_r_;  // swept: changed by the last sweep
  Mat q_, lambda_;                               // where it evaluated, beyond the start
  Vec a_0_, eta_0_;
  Vec end_nu_, end_v_, slope_end_;  // at the step's end, of its result
  double weights_h_ = 0;
  Weights weights_[points], inside_;
  double inside_at_ = -1, inside_h_ = 0;  // of inside_
  Slope slope_;
  Eigen::Matrix<double, points, points> ahead_;  // column i: weights of the past points
  double ahead_by_ = 0;
  Vec beyond_, rest_, xi_, eta_, x_, v_i_, q_i_, rate_, e_, e_v_;
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
                    .doc = "of a step over its six points beyond the start: order 10 with 3; 1 (order 8) for forces "
                           "that hardly depend on velocities"})))
