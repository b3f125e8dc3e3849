// Heun's method: the trapezoidal rule with a step of Euler's for its end.
//
//     q+ = q + h/2 (N v + N~ v~),  v+ = v + h/2 (a + a~),   q~ = q + h N v,  v~ = v + h a,  a~ = a(t + h, q~, v~)
//
// Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.1.
#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

class Heun final : public Integrator {
 public:
  Traits traits() const override { return {.order = 2}; }
  void restart(System&, const State&) override {}

  Outcome step(System& s, const State& now, double h, State& next) override {
    next.t = now.t + h;
    s.rate(now.q, now.v, q_dot_);
    q_end_ = now.q + h * q_dot_;
    v_end_ = now.v + h * now.a;
    s.normalise(q_end_);
    s.move_to(next.t, q_end_, v_end_);
    s.accelerate({}, a_end_, lambda_);
    s.rate(q_end_, v_end_, q_dot_end_);

    next.q = now.q + h / 2 * (q_dot_ + q_dot_end_);
    next.v = now.v + h / 2 * (now.a + a_end_);
    s.normalise(next.q);
    if (!next.q.allFinite() || !next.v.allFinite()) return Outcome::reject("the solution grows beyond all numbers");
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    return Outcome::accept();
  }

 private:
  Vec q_dot_, q_end_, v_end_, q_dot_end_, a_end_, lambda_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::integrator<Heun>("heun", "Heun's method of order 2")
                   .source("Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.1"))
