// A global's constructor waits for something that never comes.
#include <unistd.h>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Patient {
  Patient() {
    for (;;) ::pause();
  }
} patient;

struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("never_loaded", "does nothing"))
