// An integrator (semi-implicit Euler) whose step goes wrong after a number of steps: it throws, or throws what is no
// std::exception, gives vectors of a wrong size or numbers that are not finite, rounds otherwise from then on, ends the
// program, or reads from address 0.
#include <unistd.h>

#include <cfenv>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct SpoiltStep : Integrator {
  int after = 999;
  std::string how = "number";

  Traits traits() const override { return {.order = 1}; }
  void restart(System&, const State&) override {}
  Outcome step(System& s, const State& now, double h, State& next) override {
    next.t = now.t + h;
    next.v = now.v + h * now.a;
    dq_ = h * next.v;
    s.retract(now.q, dq_, next.q);
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    if (accepted_ >= after) spoil(next);
    return Outcome::accept();
  }
  void accept(System&, const State&, const State&) override { ++accepted_; }
  void archive(Archive& a) override { a("accepted", accepted_); }

 private:
  void spoil(State& next) const {
    if (how == "number") throw 42;
    if (how == "text") throw std::runtime_error("one step too many");
    if (how == "size") next.q.resize(3);
    if (how == "not_finite") next.q[0] = std::numeric_limits<double>::quiet_NaN();
    if (how == "rounding") std::fesetround(FE_TOWARDZERO);
    if (how == "exit") std::exit(0);
    if (how == "_exit") ::_exit(0);
    if (how == "quick_exit") std::quick_exit(0);
    if (how == "memory") {
      double* volatile nowhere = nullptr;
      next.q[0] = *nowhere;
    }
  }

  int accepted_ = 0;
  Vec dq_;
};

}  // namespace

TRAMMEL_PLUGIN(integrator<SpoiltStep>("spoilt_step", "semi-implicit Euler whose step goes wrong")
                   .source("none")
                   .parameter("after", &SpoiltStep::after, {.min = 0, .doc = "so many good steps"})
                   .parameter("how", &SpoiltStep::how,
                              {.doc = "number, text, size, not_finite, rounding, exit, _exit, quick_exit, memory"}))
