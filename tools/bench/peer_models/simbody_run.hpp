// A run of a Simbody model by its error-controlled Runge-Kutta-Merson method, observed at equal times.
#pragma once

#include <Simbody.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "measured.hpp"

namespace peers {

inline std::string simbody_version() {
  int major, minor, build;
  SimTK_version_simbody(&major, &minor, &build);
  return "Simbody " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

/// Messages of exceptions run over several lines and quote files.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '"' || c == '\\' || c == '\n'; }, ' ');
  return text;
}

/// From `start` to `until` at `accuracy` (its tolerance for constraints follows: a tenth of it), observed every `every` seconds.
inline Measured run(const SimTK::MultibodySystem& system, const SimTK::State& start, double accuracy, double until,
                    double every, const std::function<std::vector<double>(const SimTK::State&)>& observe) {
  Measured m;
  m.peer = simbody_version();
  SimTK::RungeKuttaMersonIntegrator method(system);
  method.setAccuracy(accuracy);
  SimTK::TimeStepper stepper(system, method);
  try {
    stepper.initialize(start);
    const long set_up = method.getNumRealizations();
    const double begin = cpu_seconds();
    for (int i = 1; i <= int(until / every + 0.5); ++i) {
      stepper.stepTo(i * every);
      const SimTK::State& now = stepper.getState();
      system.realize(now, SimTK::Stage::Velocity);
      m.series.emplace_back(now.getTime(), observe(now));
      m.cpu = cpu_seconds() - begin;
    }
    m.evaluations = method.getNumRealizations() - set_up;
  } catch (const std::exception& e) {
    m.failure = one_line(e.what());
  }
  m.steps = method.getNumStepsTaken();
  return m;
}

}  // namespace peers
