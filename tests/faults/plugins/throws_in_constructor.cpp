// The component's constructor throws, so not even its defaults can be read.
#include <stdexcept>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Idle : trammel::Correction {
  Idle() { throw std::runtime_error("out of luck"); }
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("throws_in_constructor", "does nothing"))
