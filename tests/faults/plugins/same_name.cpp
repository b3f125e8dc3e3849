// Declares an integrator of a name that good.so has already.
#include <trammel/integrator.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Other : trammel::Integrator {
  trammel::Traits traits() const override { return {}; }
  void restart(trammel::System&, const trammel::State&) override {}
  trammel::Outcome step(trammel::System&, const trammel::State&, double, trammel::State&) override {
    return trammel::Outcome::reject("not a method");
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::integrator<Other>("good", "declared by another library too"))
