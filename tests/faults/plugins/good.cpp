// A sound plugin with a component of two kinds, for the registry to find, load and be given truncated copies of.
#include <trammel/contact.hpp>
#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// Explicit Euler, with the ability of linear interpolation.
struct Good : Integrator, DenseOutput {
  double damping = 0.5;

  Traits traits() const override { return {.order = 1}; }
  void restart(System&, const State&) override {}
  Outcome step(System& s, const State& now, double h, State& next) override {
    s.rate(now.q, now.v, next.q);
    next.t = now.t + h;
    next.q = now.q + h * next.q;
    next.v = now.v + h * now.a;
    s.normalise(next.q);
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    return Outcome::accept();
  }
  void interpolate(System&, const State& now, const State& next, double theta, State& at) override {
    at.t = now.t + theta * (next.t - now.t);
    at.q = now.q + theta * (next.q - now.q);
    at.v = now.v + theta * (next.v - now.v);
  }
  void prepare(const World&) override {
    if (damping == 0.25) throw ParameterError("damping", "a quarter is not possible");
  }
};

struct GoodContact : Restitution {
  double coefficient(double) const override { return 0; }
  Treatment treatment() const override { return {}; }
};

}  // namespace

TRAMMEL_PLUGIN(integrator<Good>("good", "explicit Euler")
                   .source("L. Euler, Institutiones calculi integralis, 1768")
                   .parameter("damping", &Good::damping, {.min = 0, .max = 1, .doc = "of nothing"}),
               contact<GoodContact>("good_contact", "perfectly plastic").source("none"))
