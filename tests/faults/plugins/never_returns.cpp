// The correction works on for ever, or crashes, or throws, once some steps are done; or a thread of its own crashes; or
// two processes return from it; or it throws where it is archived.
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <stdexcept>
#include <string>
#include <thread>

#include "idle.hpp"

namespace {
struct NeverReturns : Idle {
  double from = 0.5;  // [s]
  std::string how = "wait";
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State& next) override {
    if (next.t < from) return trammel::Outcome::accept();
    if (how == "crash") std::raise(SIGSEGV);
    if (how == "throw") throw std::runtime_error("no way back");
    if (how == "thread") std::thread([] { std::raise(SIGSEGV); }).join();
    if (how == "exit") ::_exit(0);
    if (how == "fork") static_cast<void>(::fork());
    if (how == "fork") return trammel::Outcome::accept();
    if (how == "archive") return trammel::Outcome::accept();
    for (;;) {
      if (how == "wait") ::usleep(1000);
      spins_ = spins_ + 1;
    }
  }

  void archive(trammel::Archive&) override {
    if (how == "archive") throw std::runtime_error("nothing to keep");
  }

 private:
  std::atomic<long> spins_ = 0;  // a loop without any effect would be no loop
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<NeverReturns>("never_returns", "does nothing for ever")
                   .parameter("from", &NeverReturns::from, {.unit = "s"})
                   .parameter("how", &NeverReturns::how,
                              {.doc = "wait, spin, crash, throw, thread, exit, fork, archive"}))
