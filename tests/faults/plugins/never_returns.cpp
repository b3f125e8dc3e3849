// The correction works on for ever, or crashes, or throws, once some steps are done.
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include "idle.hpp"

namespace {
struct NeverReturns : Idle {
  double from = 0.5;  // [s]
  std::string how = "wait";
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State& next) override {
    if (next.t < from) return trammel::Outcome::accept();
    if (how == "crash") std::raise(SIGSEGV);
    if (how == "throw") throw std::runtime_error("no way back");
    for (volatile int i = 0;; i = i + 1)
      if (how == "wait") ::usleep(1000);
  }
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<NeverReturns>("never_returns", "does nothing for ever")
                   .parameter("from", &NeverReturns::from, {.unit = "s"})
                   .parameter("how", &NeverReturns::how, {.doc = "wait, spin, crash, throw"}))
