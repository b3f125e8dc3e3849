#include "plugin/process/settings.hpp"

#include <clocale>
#include <cstdint>
#include <cstring>
#include <limits>

namespace trammel::plugin {

// Tests the arithmetic itself, not control registers, so that it works on every processor. Sums of denormals are fast.
const char* arithmetic_fault() noexcept {
#if defined(__GLIBC__)
  if (::fegetexcept() != 0) return "floating-point exceptions have become traps, which end the program";
#endif
  // Less than half of the distance from 1 to its neighbours: with rounding to nearest, sum and difference are 1.
  const volatile double one = 1, little = 0x1p-55, least = std::numeric_limits<double>::denorm_min();
  const volatile double above = one + little, below = one - little, twice = least + least;
  if (above != 1 || below != 1) return "numbers are no longer rounded to nearest";
  // Compared as integers: if denormals are read as 0, a comparison of numbers finds them equal to 0.
  const double read = twice;
  std::uint64_t bits;
  std::memcpy(&bits, &read, sizeof bits);
  return bits == 2 ? "" : "numbers below 2.2e-308 (denormals) have become 0";
}

ProcessSettings::ProcessSettings() : locale_(std::setlocale(LC_ALL, nullptr)) {
  std::fegetenv(&arithmetic_);
}

ProcessSettings::~ProcessSettings() {
  put_back();
}

void ProcessSettings::put_back() noexcept {
  std::fesetenv(&arithmetic_);
  if (locale_ != std::setlocale(LC_ALL, nullptr)) std::setlocale(LC_ALL, locale_.c_str());
}

}  // namespace trammel::plugin
