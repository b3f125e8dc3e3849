// Symplectic Euler that says it does not take one kind of system.
#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Limited final : Integrator {
  enum class Without { nothing, rows, redundant_rows, friction, jumps, rotations, events };
  Without without = Without::nothing;

  Traits traits() const override {
    return {.rows = without != Without::rows,
            .redundant_rows = without != Without::redundant_rows,
            .friction = without != Without::friction,
            .jumps = without != Without::jumps,
            .rotations = without != Without::rotations,
            .events = without != Without::events};
  }
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

TRAMMEL_PLUGIN(trammel::integrator<Limited>("limited", "for tests: takes all but one kind of system")
                   .choice("without", &Limited::without,
                           {{"nothing", Limited::Without::nothing},
                            {"rows", Limited::Without::rows},
                            {"redundant_rows", Limited::Without::redundant_rows},
                            {"friction", Limited::Without::friction},
                            {"jumps", Limited::Without::jumps},
                            {"rotations", Limited::Without::rotations},
                            {"events", Limited::Without::events}}))
