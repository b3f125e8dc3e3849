// A global's constructor throws, so nobody can catch it: the program that loads this library ends.
#include <stdexcept>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Licence {
  Licence() { throw std::runtime_error("no licence found"); }
} licence;

struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("throws_at_load", "does nothing"))
