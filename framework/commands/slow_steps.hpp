// A run that crawls: controlled steps far shorter than its records need, and no end in sight.
#pragma once

#include <string>

#include "simulate/start/setup.hpp"
#include "simulate/simulator.hpp"

namespace trammel::simulate {

class SlowSteps {
 public:
  // Where the run stands before its first step here.
  SlowSteps(double t, long long steps) : t_(t), steps_(steps) {}

  // After `seconds` of wall-clock time: what makes the steps so short, and the setting that cures it. Empty: the run is not slow, it
  // is too early to tell, or it was said.
  std::string look(double seconds, const Setup& setup, Simulator& simulator);

 private:
  // At the last look.
  double t_;
  long long steps_;
  double last_look_ = 0, next_look_ = 2;  // [s]
};

}  // namespace trammel::simulate
