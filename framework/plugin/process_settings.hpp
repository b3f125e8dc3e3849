// What a library may leave changed in the process that it is loaded into: the rounding of floating-point numbers, denormals
// flushed to 0 (a library linked with -ffast-math does that), the C locale. Results rely on the IEEE rules.
#pragma once

#include <cfenv>
#include <string>

namespace trammel::plugin {

// In what floating-point arithmetic differs from the IEEE default; "" if it does not. Some nanoseconds.
const char* arithmetic_fault() noexcept;

// The settings at its making, put back at its end or before.
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
