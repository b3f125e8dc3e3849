// A run of a Simbody model by its error-controlled Runge-Kutta-Merson method, observed at equal times.
#pragma once

#include <Simbody.h>

#include <functional>
#include <vector>

#include "measured.hpp"

namespace peers {

inline std::string simbody_version() {
  int major, minor, build;
  SimTK_version_simbody(&major, &minor, &build);
  return "Simbody " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

/// What an exception says, without its first line, the place it was thrown at, and without what JSON would escape.
inline std::string reason(const std::exception& e) {
  std::string text = e.what();
  text.erase(0, text.find('\n') + 1);
  for (char& c : text) {
    if (c == '"' || c == '\\' || c == '\n') c = ' ';
  }
  return text;
}

// / From `start` to `until` at `accuracy` (its tolerance for constraints follows: a tenth of it), observed every
// `every` seconds.
inline Measured run(const SimTK::MultibodySystem& system, const SimTK::State& start, double accuracy, double until,
                    double every, const std::function<std::vector<double>(const SimTK::State&)>& observe) {
  Measured m;
  m.peer = simbody_version();
  SimTK::RungeKuttaMersonIntegrator method(system);
  method.setAccuracy(accuracy);
  SimTK::TimeStepper stepper(system, method);
  long set_up = 0;
  try {
    stepper.initialize(start);
    set_up = method.getNumRealizations();
    const double begin = cpu_seconds();
    for (int i = 1; i <= int(until / every + 0.5); ++i) {
      stepper.stepTo(i * every);
      const SimTK::State& now = stepper.getState();
      system.realize(now, SimTK::Stage::Velocity);
      m.series.emplace_back(now.getTime(), observe(now));
      m.cpu = cpu_seconds() - begin;
    }
  } catch (const std::exception& e) {
    m.failure = reason(e);
  }
  m.evaluations = method.getNumRealizations() - set_up;
  m.steps = method.getNumStepsTaken();
  return m;
}

}  // namespace peers
