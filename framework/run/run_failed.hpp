// The run cannot go on: diverged, step too small, event storm. What came before is kept; exit code 1.
#pragma once

#include <stdexcept>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class RunFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A component returned numbers that are not finite. `ending` (commands/ending.hpp) decides whose fault it is: the
// plugin's, or that of a law of time in the scene, such as sqrt(1-t).
class NotFinite : public RunFailed {
 public:
  NotFinite(const std::string& when, const model::CallSite& where) : RunFailed(when), site_(where) {}
  const model::CallSite& site() const { return site_; }

 private:
  model::CallSite site_;
};

// The integrator's step returned something that cannot be the next state; what() names it.
class BadStep : public RunFailed {
 public:
  using RunFailed::RunFailed;
};

}  // namespace trammel::simulate
