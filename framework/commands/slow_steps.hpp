// Detects slow runs: controlled steps far shorter than the records need, with a long time left.
#pragma once

#include <string>

#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::simulate {

class SlowSteps {
 public:
  // The run's progress before its first step here.
  SlowSteps(double t, long long steps) : t_(t), steps_(steps) {}

  // Why the steps are so short, and a setting that avoids it, after `seconds` of CPU time. (Wall-clock time would
  // depend on how busy the machine is.) Empty: the run is not slow, it is too early to decide, or the message was given
  // before.
  std::string look(double seconds, const Setup& setup, Simulator& simulator);

 private:
  // At the last look.
  double t_;
  long long steps_;
  double last_look_ = 0, next_look_ = 2;  // [s]
};

}  // namespace trammel::simulate
