// Process settings that a library may change: the rounding mode, flushing of denormals to 0 (by a library linked with
// -ffast-math), traps at floating-point exceptions, the C locale. Results depend on the IEEE rules.
#pragma once

#include <cfenv>
#include <string>

namespace trammel::plugin {

// Describes how floating-point arithmetic differs from the IEEE default; "" if it does not. Takes some nanoseconds.
const char* arithmetic_fault() noexcept;

// Saves the settings in its constructor and restores them in its destructor or earlier.
class ProcessSettings {
 public:
  ProcessSettings();
  ~ProcessSettings();
  ProcessSettings(const ProcessSettings&) = delete;
  ProcessSettings& operator=(const ProcessSettings&) = delete;
  void put_back() noexcept;

 private:
  std::fenv_t arithmetic_;
  std::string locale_;
};

}  // namespace trammel::plugin
