// The function that returns the declarations throws.
#include <stdexcept>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};

const char* name() {
  throw std::runtime_error("no name comes to mind");
}
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>(name(), "does nothing"))
