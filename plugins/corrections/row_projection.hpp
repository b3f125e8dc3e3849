// Restores position and velocity rows by the least change in the metric of a matrix S (the identity or M):
//
//     q <- q (+) dq,   [S G^T; G 0] (dq, mu) = -(0, g)            repeated (Newton) until g is at round-off
//     v <- v + dv,     [S G^T; G 0] (dv, mu) = -(0, G v + g_t)    at the new q; twice, to reduce round-off
//
// The positions use the factors of the first q as long as each iteration reduces g by a factor of ten.
//
// With S = 1 this is dq = -G^+ g (Moore-Penrose), with S = M dq = -M^-1 G^T (G M^-1 G^T)^+ g. Both are the step-wise
// corrections of Chen Xiangyang, Chinese J. Comput. Mech. 19, 74-77 (2002), after Taylor's series of g about q.
#pragma once

#include <limits>

#include <trammel/correction.hpp>

namespace trammel {

template <Blend S>
class RowProjection final : public Correction {
 public:
  bool corrects(Level level) const override { return level == Level::position || level == Level::velocity; }
  Outcome apply(Level level, System& s, const Step&, State& state) override {
    return level == Level::position ? position(s, state) : velocity(s, state);
  }

 private:
  Outcome position(System& s, State& state) {
    double before = 0;
    bool fresh = true;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      s.move_to(state.t, state.q, state.v);
      const double violation = s.sizes().nc > 0 ? s.g().lpNorm<Eigen::Infinity>() : 0;
      // A coordinate whose exact value is 0 would decrease by all its digits in every iteration.
      if (!(violation > round_off * state.q.lpNorm<Eigen::Infinity>())) return Outcome::accept();
      // If an iteration does not halve a small residual, the rest is round-off. If redundant rows contradict each other
      // at this level, an iteration may increase it and is undone.
      if (iteration > 0 && violation > 0.5 * before) {
        if (violation > before && violation <= settled) state.q = start_of_step_;
        if (violation <= settled) return Outcome::accept();
        if (fresh) return Outcome::reject("the correction of the positions diverges");
      }
      fresh = iteration == 0 || violation > 0.1 * before;
      before = violation;
      if (fresh) factorise(s);
      if (!solve(s, s.g())) return Outcome::reject("the correction of the positions has no solution");
      s.retract(state.q, change_, moved_);
      start_of_step_ = state.q;
      state.q = moved_;
    }
    return Outcome::reject("the correction of the positions does not converge");
  }

  Outcome velocity(System& s, State& state) {
    for (int pass = 0; pass < 2; ++pass) {
      s.move_to(state.t, state.q, state.v);
      if (s.sizes().nc == 0) break;
      const double violation = s.g_dot().lpNorm<Eigen::Infinity>();
      if (!(violation > round_off * state.v.lpNorm<Eigen::Infinity>())) break;
      if (pass == 0) factorise(s);
      if (!solve(s, s.g_dot())) return Outcome::reject("the correction of the velocities has no solution");
      state.v += change_;
    }
    return Outcome::accept();
  }

  static constexpr int most_iterations = 20;
  static constexpr double round_off = std::numeric_limits<double>::epsilon();
  static constexpr double settled = 1e-9;  // [unit of the rows] far above round-off, far below a useful violation

  void factorise(System& s) {
    zero_.setZero(s.sizes().nv);
    s.factorise(S, zero_, zero_rows_.setZero(s.sizes().nc), Factors::projection);
  }

  bool solve(System& s, const Vec& violation) {
    right_ = violation;
    return s.correct(zero_, right_, change_, multipliers_, Factors::projection);
  }

  Vec right_, zero_, zero_rows_, change_, multipliers_, moved_, start_of_step_;
};

}  // namespace trammel
