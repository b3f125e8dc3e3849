// `prepare` throws something that is neither a ParameterError nor any other std::exception.
#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {
struct Idle : trammel::Correction {
  void prepare(const trammel::World&) override { throw 42; }
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("throws_in_prepare", "does nothing"))
