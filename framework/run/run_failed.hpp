// The run cannot go on: diverged, step too small, event storm. What came before is kept; exit code 1.
#pragma once

#include <stdexcept>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class RunFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Because a component answered with numbers that are not finite. Simulation tells whose fault it is: the plugin's, or
// that of a law of time in the scene, such as sqrt(1-t).
class NotFinite : public RunFailed {
 public:
  NotFinite(const std::string& when, const model::CallSite& where) : RunFailed(when), site_(where) {}
  const model::CallSite& site() const { return site_; }

 private:
  model::CallSite site_;
};

// Because the integrator's step came back with something that cannot be the next state. what() says with what.
class BadStep : public RunFailed {
 public:
  using RunFailed::RunFailed;
};

}  // namespace trammel::simulate
