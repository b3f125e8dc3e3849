// A global's constructor is killed by a signal.
#include <csignal>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Crash {
  Crash() { std::raise(SIGKILL); }
} crash;

struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("crashes_at_load", "does nothing"))
