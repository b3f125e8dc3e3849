// Remembers which component to name when the process crashes or hangs inside a plugin, and how to save the records
// then. A signal handler cannot allocate or call into the program, so everything that it may need is prepared while
// plugins are called. The component being called is the breadcrumb that the assembled system leaves.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "simulate/results/last_result.hpp"
#include "simulate/results/recorder.hpp"
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class CrashWitness {
 public:
  struct Clock {
    const double* t = nullptr;         // [s]
    const long long* steps = nullptr;  // accepted so far; null: outside a run
  };
  // The arguments must live until `leave`; the recorder may still be missing. The interface call is in
  // plugin::Breadcrumb; without a breadcrumb the culprit is the integrator's step.
  void follow(const Setup& setup, const model::AssembledSystem& system, Clock clock);
  void record_with(const Recorder& recorder, const LastResult& result) {
    recorder_ = &recorder;
    result_ = &result;
  }
  void leave();

  // --- for the signal handler: no allocation, nothing thrown ---
  struct Culprit {
    const plugin::Origin* origin = nullptr;  // null: no called component is known
    const char* call = "";
    std::optional<double> t;
    std::optional<long long> step;
    bool certain = true;  // false: the integrator's step, or the framework on its behalf
  };
  Culprit culprit() const noexcept;
  // Writes the records still in memory, and a result that states how the run ended.
  void rescue(const char* status, std::string_view reason) const noexcept;

 private:
  std::atomic<bool> watching_ = false;
  plugin::Origin integrator_;
  const model::AssembledSystem* system_ = nullptr;
  Clock clock_;
  const Recorder* recorder_ = nullptr;
  const LastResult* result_ = nullptr;
};

// Makes a witness, if there is one, follow during the object's lifetime.
class WitnessScope {
 public:
  WitnessScope(CrashWitness* witness, const Setup& setup, const model::AssembledSystem& system,
               CrashWitness::Clock clock)
      : witness_(witness) {
    if (witness_) witness_->follow(setup, system, clock);
  }
  ~WitnessScope() {
    if (witness_) witness_->leave();
  }
  WitnessScope(const WitnessScope&) = delete;
  WitnessScope& operator=(const WitnessScope&) = delete;

 private:
  CrashWitness* witness_;
};

}  // namespace trammel::simulate
