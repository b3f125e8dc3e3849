// Symplectic Euler for systems without rows: v += h a, then q (+) h v.
#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct FreeEuler final : Integrator {
  Traits traits() const override { return {.order = 1, .rows = false}; }
  void restart(System&, const State&) override {}
  Outcome step(System& s, const State& now, double h, State& next) override {
    next.t = now.t + h;
    next.v = now.v + h * now.a;
    s.retract(now.q, h * next.v, next.q);
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    return Outcome::accept();
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::integrator<FreeEuler>("free_euler", "for tests: takes no rows"))
