// An integrator (semi-implicit Euler) that works for 999 steps and throws in the next.
#include <stdexcept>

#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct ThrowsInStep1000 : Integrator {
  Traits traits() const override { return {.order = 1}; }
  void restart(System&, const State&) override {}
  Outcome step(System& s, const State& now, double h, State& next) override {
    if (accepted_ == 999) throw std::runtime_error("the thousandth step is one too many");
    next.t = now.t + h;
    next.v = now.v + h * now.a;
    dq_ = h * next.v;
    s.retract(now.q, dq_, next.q);
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    return Outcome::accept();
  }
  void accept(System&, const State&, const State&) override { ++accepted_; }
  void archive(Archive& a) override { a("accepted", accepted_); }

 private:
  int accepted_ = 0;
  Vec dq_;
};

}  // namespace

TRAMMEL_PLUGIN(integrator<ThrowsInStep1000>("throws_in_step_1000", "throws in step 1000").source("none"))
