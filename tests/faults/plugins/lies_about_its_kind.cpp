// Declared as a body, but it derives from another interface.
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

TRAMMEL_PLUGIN(trammel::body<Idle>("lies_about_its_kind", "no body at all"))
