// Declares the same name twice.
#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("idle", "does nothing"), trammel::correction<Idle>("idle", "nor does this"))
