// Calls a function that nobody defines.
#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

void a_function_that_nobody_defines();

namespace {
struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    a_function_that_nobody_defines();
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("missing_symbol", "does nothing"))
