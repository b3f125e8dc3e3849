// A global's constructor ends the program.
#include <cstdlib>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Impatient {
  Impatient() { std::_Exit(7); }
} impatient;

struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("exits_at_load", "does nothing"))
