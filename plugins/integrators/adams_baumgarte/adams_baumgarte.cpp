// The Adams-Bashforth-Moulton method of fourth order in PECE form with Baumgarte's stabilisation, for the first-order
// form y = (q, v), y' = F(t, y) of RungeKutta:
//
//     P  y* = y_n + h/24 (55 F_n - 59 F_{n-1} + 37 F_{n-2} - 9 F_{n-3})    "ab4", as published
//        y* = y_n + h/12 (23 F_n - 16 F_{n-1} + 5 F_{n-2})                 "ab3", stable to omega h = 1.178
//     C  y_{n+1} = y_n + h/24 (9 F(t_{n+1}, y*) + 19 F_n - 5 F_{n-1} + F_{n-2})
//
// The classical Runge-Kutta method of the same order starts it, after a restart and whenever h changes. With the AB4
// predictor the method is unstable on the whole imaginary axis (weakly: growth of 1.6e-7 per step at omega h = 0.1), so
// that undamped modes need omega h well below 1. Error estimate (Milne): -19/270 of predictor minus corrector for AB4.
// Baumgarte, CMAME 1, 1-16 (1972); Hairer, Norsett, Wanner, Solving ODEs I, III.1.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <trammel/linear_theory.hpp>
#include <trammel/methods/linear_roots.hpp>
#include <trammel/methods/runge_kutta.hpp>
#include <trammel/plugin.hpp>
#include <trammel/row_parameters.hpp>

namespace {

using namespace trammel;

constexpr double c[] = {0, 0.5, 0.5, 1};
constexpr double a[] = {0.5, 0, 0.5, 0, 0, 1};
constexpr double b[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
constexpr double same_length = 1e-9;  // relative difference of two steps up to which the history serves
constexpr double starter_less_embedded[] = {0, 0, 0, 1.0 / 6, -1.0 / 6};  // as in runge_kutta_4

constexpr double bashforth_4[] = {55.0 / 24, -59.0 / 24, 37.0 / 24, -9.0 / 24};
constexpr double bashforth_3[] = {23.0 / 12, -16.0 / 12, 5.0 / 12, 0};
constexpr double moulton_4[] = {19.0 / 24, -5.0 / 24, 1.0 / 24, 0};  // of past slopes; the prediction has 9/24

class AdamsBaumgarte final : public Integrator, public ErrorEstimate, public LinearTheory {
 public:
  enum class Predictor { ab4, ab3 };
  double delta = 10, epsilon = 50;
  Predictor predictor = Predictor::ab4;
  RungeKutta::Rows rows = RungeKutta::Rows::baumgarte;

  void prepare(const World&) override { starter_.baumgarte = {delta, epsilon}, starter_.rows = rows; }
  Traits traits() const override {
    return {.order = 4,
            .steps = past_wanted(),
            .holds_position = starter_.projects(),
            .holds_velocity = starter_.projects()};
  }

  void restart(System& s, const State& now) override {
    starter_.begin(s, now, past_[0]);
    filled_ = 1;
    h_ = 0;
  }

  Outcome step(System& s, const State& now, double h, State& next) override {
    trial_h_ = h;
    multistep_ = filled_ >= past_wanted() && same_step(h);
    if (!multistep_) return starter_.step(s, now, past_[0], h, next);
    return starter_.within_step(s, now, [&] { return predict_and_correct(s, now, h, next); });
  }

  void accept(System& s, const State& now, const State& next) override {
    const double h = step_to(now.t, next.t);
    if (!same_step(h)) filled_ = 1;  // only the slope at the step's start remains usable
    h_ = h;
    for (std::size_t i = past_.size() - 1; i > 0; --i) {
      past_[i].q.swap(past_[i - 1].q), past_[i].v.swap(past_[i - 1].v);
      past_[i].lambda.swap(past_[i - 1].lambda);
    }
    s.rate(next.q, next.v, past_[0].q);
    past_[0].v = next.a;
    past_[0].lambda = next.lambda;
    filled_ = std::min(filled_ + 1, int(past_.size()));
  }

  double error(System& s, const State& now, const State& next, const Tolerance& tolerance) override {
    if (multistep_) {
      const double milne = predictor == Predictor::ab4 ? -19.0 / 270 : 1;
      e_ = milne * (next.q - predicted_q_);
      e_v_ = milne * (next.v - predicted_v_);
      starter_.forget();
      return starter_.norm(s, now, next, e_, e_v_, RungeKutta::Part::whole, tolerance);
    }
    return starter_.error(now, next, [&](RungeKutta::Part part) {
      starter_.combine(starter_less_embedded, 5, e_, e_v_);
      return starter_.norm(s, now, next, e_, e_v_, part, tolerance);
    });
  }
  int error_order() const override { return multistep_ && predictor == Predictor::ab4 ? 5 : 4; }

  // y_{n+1} = y_n + z sum_i moulton_i y_{n-i} + 9/24 z (y_n + z sum_i bashforth_i y_{n-i})
  Roots roots(double Omega, double zeta) const override {
    const double* bashforth = predictor == Predictor::ab4 ? bashforth_4 : bashforth_3;
    Roots all;
    for (const std::complex<double> z : oscillator_eigenvalues(Omega, zeta)) {
      Eigen::VectorXcd powers(4);
      for (int i = 0; i < 4; ++i) powers[i] = z * moulton_4[i] + 9.0 / 24 * z * z * bashforth[i];
      powers[0] += 1.0 + 9.0 / 24 * z;
      const Roots of_one = polynomial_roots(powers);
      all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
  }

  void archive(Archive& archive) override {
    starter_.archive(archive);
    archive("filled", filled_);
    archive("h", h_);
    if (filled_ < 0 || std::size_t(filled_) > past_.size()) throw std::out_of_range("filled");
    for (std::size_t i = 0; i < past_.size(); ++i) {
      if (i >= std::size_t(filled_)) past_[i] = {};  // from before a restart, possibly of another size
      const std::string name = "past_" + std::to_string(i);
      archive(name + "_q", past_[i].q);
      archive(name + "_v", past_[i].v);
      archive(name + "_lambda", past_[i].lambda);
    }
    for (std::size_t i = 0; i < std::size_t(filled_); ++i)
      if (past_[i].q.size() == 0 || past_[i].v.size() == 0) throw std::length_error("past");
  }

 private:
  Outcome predict_and_correct(System& s, const State& now, double h, State& next) {
    go_on(now, h, predictor == Predictor::ab4 ? bashforth_4 : bashforth_3, predicted_q_, predicted_v_);
    if (!starter_.evaluate(s, now.t + h, predicted_q_, predicted_v_, predicted_))
      return Outcome::reject(RungeKutta::diverged);

    next.t = now.t + h;
    go_on(now, h, moulton_4, next.q, next.v);
    next.q += h * 9.0 / 24 * predicted_.q;
    next.v += h * 9.0 / 24 * predicted_.v;
    if (!starter_.evaluate(s, next.t, next.q, next.v, corrected_)) return Outcome::reject(RungeKutta::diverged);
    s.normalise(next.q);
    if (starter_.projects()) starter_.taken_at(next.q, next.v);
    next.a = corrected_.v;
    next.lambda = corrected_.lambda;
    return Outcome::accept();
  }

  int past_wanted() const { return predictor == Predictor::ab4 ? 4 : 3; }
  bool same_step(double h) const { return std::abs(h - h_) <= same_length * h; }

  // to - from, or the length of the last trial or of the last accepted step if that is the same up to round-off of t.
  // Callers then compare lengths exactly, because another step may have been tried since.
  double step_to(double from, double to) const {
    const double h = to - from;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(from), std::abs(to));
    for (const double known : {trial_h_, h_})
      if (std::abs(h - known) <= rounding) return known;
    return h;
  }

  // y_n + h sum_i weights_i F_{n-i}
  void go_on(const State& now, double h, const double* weights, Vec& q, Vec& v) const {
    const double w[] = {h * weights[0], h * weights[1], h * weights[2], h * weights[3]};
    const auto three = [&](const Vec& y, Vec Slope::*F) {
      return y + w[0] * past_[0].*F + w[1] * past_[1].*F + w[2] * past_[2].*F;
    };
    if (weights[3] == 0) {  // the fourth slope may not exist
      q = three(now.q, &Slope::q), v = three(now.v, &Slope::v);
    } else {
      q = three(now.q, &Slope::q) + w[3] * past_[3].q, v = three(now.v, &Slope::v) + w[3] * past_[3].v;
    }
  }

  RungeKutta starter_{{4, c, a, b}};
  std::array<Slope, 4> past_;  // at the last accepted point, one h before, ...
  int filled_ = 0;             // number of valid slopes
  double h_ = 0;               // their distance in time
  // Data of the last trial.
  bool multistep_ = false;
  double trial_h_ = 0;
  Slope predicted_, corrected_;
  Vec predicted_q_, predicted_v_, e_, e_v_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::row_parameters(
    trammel::integrator<AdamsBaumgarte>(
        "adams_baumgarte",
        "Adams-Bashforth-Moulton PECE of fourth order with Baumgarte's stabilisation, for "
        "constant steps: each change of the step restarts it by runge_kutta_4, so "
        "error-controlled steps are mostly those of that method")
        .source(
            "Baumgarte 1972, Comput. Methods Appl. Mech. Eng. 1, 1-16; Hairer, Norsett, Wanner, Solving ODEs I, III.1")
        .choice("predictor", &AdamsBaumgarte::predictor,
                {{"ab4", AdamsBaumgarte::Predictor::ab4}, {"ab3", AdamsBaumgarte::Predictor::ab3}},
                {.doc = "ab4 as published; ab3 keeps undamped modes stable up to omega h = 1.178"})))
