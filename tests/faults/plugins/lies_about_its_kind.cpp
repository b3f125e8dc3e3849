// Declared as a body, but it derives from another interface.
#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Idle : trammel::Correction {
  trammel::Outcome apply(trammel::System&, const Step&, trammel::State&) override { return trammel::Outcome::accept(); }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::body<Idle>("lies_about_its_kind", "no body at all"))
