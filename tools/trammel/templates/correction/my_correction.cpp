// The correction of least kinetic energy, to change:
//
//     q <- q (+) dq,   [M G^T; G 0] (dq, mu) = -(0, g)            repeated until g is at round-off
//     v <- v + dv,     [M G^T; G 0] (dv, mu) = -(0, G v + g_t)
#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class MyCorrection final : public Correction {
 public:
  double tolerance = 1e-13;

  bool corrects(Level level) const override { return level == Level::position || level == Level::velocity; }

  Outcome apply(Level level, System& s, const Step&, State& state) override {
    for (int i = 0; i < 20; ++i) {
      s.move_to(state.t, state.q, state.v);
      const Vec& off = level == Level::position ? s.g() : s.g_dot();
      if (off.size() == 0 || off.lpNorm<Eigen::Infinity>() <= tolerance) return Outcome::accept();
      zero_.setZero(s.sizes().nv), zero_rows_.setZero(off.size());
      s.factorise({.c_m = 1}, zero_, zero_rows_, Factors::projection);
      if (!s.correct(zero_, off, change_, mu_, Factors::projection)) break;
      if (level == Level::velocity)
        state.v += change_;
      else
        s.retract(state.q, change_, moved_), state.q = moved_;
    }
    return Outcome::reject("the correction does not converge");
  }

 private:
  Vec zero_, zero_rows_, change_, mu_, moved_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::correction<MyCorrection>("my_correction", "rows restored by the least change, to change")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77")
                   .parameter("tolerance", &MyCorrection::tolerance,
                              {.min = 1e-15, .max = 1e-6, .doc = "of the rows, in their units"}))
