// Making the component ends the program, as if all were well.
#include <cstdlib>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Ends : trammel::Correction {
  Ends() { std::exit(0); }
  double weight = 1;
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(
    trammel::correction<Ends>("ends_in_constructor", "does nothing").source("none").parameter("weight", &Ends::weight))
