// Who to name when the process crashes inside a plugin: a signal handler can build nothing and ask nobody, so all it may need
// stands ready here while a run goes on. The component being called is the breadcrumb that the assembled system leaves.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "model/assembled_system.hpp"
#include "plugin/registry.hpp"
#include "simulate/recorder.hpp"
#include "simulate/setup.hpp"
#include "simulate/simulator.hpp"

namespace trammel::simulate {

class CrashWitness {
 public:
  // From here to `leave` the arguments live, the recorder perhaps not yet.
  void follow(const Setup& setup, const scene::Value& root, plugin::Registry& registry, Simulator& simulator);
  void record_with(const Recorder& recorder) { recorder_ = &recorder; }
  void leave();

  // --- for the signal handler: no allocation, nothing thrown ---
  struct Culprit {
    const plugin::Origin* origin;
    const char* call;
    double t;
    long long step;
    bool certain;  // false: the integrator's step, or the framework on its behalf
  };
  bool watching() const noexcept { return watching_; }
  Culprit culprit() const noexcept;
  void rescue() const noexcept;  // records still in memory go out

 private:
  std::atomic<bool> watching_ = false;
  std::vector<std::pair<const std::string*, plugin::Origin>> origins_;  // by the entry's name in the model
  plugin::Origin integrator_;
  Simulator* simulator_ = nullptr;
  const Recorder* recorder_ = nullptr;
};

}  // namespace trammel::simulate
