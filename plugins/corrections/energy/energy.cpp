// The kinetic energy made what the balance asks for, T* = E_start + supplied - dissipated - U(q), by the change of least kinetic
// energy that keeps the velocity rows:
//
//     v = v_t + n,   v_t of least T with G v_t = -g_t,   n in null(G):   T(v) = T(v_t) + T(n)
//     v' = v_t + s n,   s^2 = (T* - T(v_t))/T(n)
//
// The two parts are orthogonal in M, so the sum of energies is exact. Where no row moves, v_t = 0 and v' = s v. This is the
// special non-holonomic constraint of Chen Xiangyang, Chinese J. Comput. Mech. 19, 74-77 (2002), eq. 8, in its M-weighted form.
//
// Near a turning point n has little to scale: relative noise of T becomes a kick. Below `least` of the largest kinetic energy
// of the run, and where T* < T(v_t), the correction waits.
#include <algorithm>
#include <cmath>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class EnergyCorrection final : public Correction {
 public:
  double least = 1e-4;

  bool corrects(Level level) const override { return level == Level::energy; }

  Outcome apply(Level, System& s, const Step& step, State& state) override {
    s.move_to(state.t, state.q, state.v);
    const Energy energy = s.energy();
    largest_ = std::max(largest_, energy.kinetic);
    const double due = step.energy - energy.potential - energy.elastic;
    n_ = state.v;
    double carried = 0;  // T(v_t)
    if (rows_move(s, state)) {
      if (!find_carried(s)) return Outcome::reject("the energy's correction cannot solve for what moving rows ask for");
      n_ -= v_t_;
      carried = kinetic(s, v_t_);
    }
    const double free = kinetic(s, n_);
    if (!(free > least * largest_) || !(due - carried > least * largest_)) return Outcome::accept();
    state.v += (std::sqrt((due - carried) / free) - 1) * n_;
    return Outcome::accept();
  }

  void archive(Archive& archive) override { archive("largest_kinetic", largest_); }

 private:
  // g_t = (G v + g_t) - G v beyond round-off
  bool rows_move(System& s, const State& state) {
    if (s.sizes().nc == 0) return false;
    g_t_ = s.g_dot();
    s.add_rows_times(-1, state.v, g_t_);
    return !g_t_.isZero(1e-14 * (1 + state.v.lpNorm<Eigen::Infinity>()));
  }
  bool find_carried(System& s) {
    zero_.setZero(s.sizes().nv);
    s.factorise({}, zero_, zero_rows_.setZero(g_t_.size()), Factors::projection);
    return s.correct(zero_, g_t_, v_t_, multipliers_, Factors::projection);
  }
  double kinetic(System& s, const Vec& v) {
    Mv_.setZero(v.size());
    s.add_mass_times(1, v, Mv_);
    return 0.5 * v.dot(Mv_);
  }

  double largest_ = 0;  // [J]
  Vec n_, v_t_, g_t_, zero_, zero_rows_, multipliers_, Mv_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::correction<EnergyCorrection>("energy", "energy: velocities scaled to what the balance asks for")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77")
        .parameter("least", &EnergyCorrection::least,
                   {.min = 0, .max = 1, .doc = "no correction below this part of the largest kinetic energy"}))
