#include "plugin/process/left_out.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace trammel::plugin {

namespace {

constexpr std::string_view variable = "TRAMMEL_LEFT_OUT=";  // the value has one library per line
constexpr const char* name = "TRAMMEL_LEFT_OUT";

// Static, because a signal handler cannot allocate.
std::array<char, 1 << 16> setting;
std::array<char*, 1 << 12> environment;

bool append(std::size_t& size, std::string_view text) {
  if (size + text.size() >= setting.size()) return false;
  std::memcpy(setting.data() + size, text.data(), text.size());
  size += text.size();
  setting[size] = '\0';
  return true;
}

// The current value. Not by getenv, which may take a lock.
std::string_view left_out_so_far() {
  for (char** entry = ::environ; entry && *entry; ++entry)
    if (std::string_view(*entry).starts_with(variable)) return std::string_view(*entry).substr(variable.size());
  return "";
}

bool copy_environment() {
  std::size_t count = 0;
  environment[count++] = setting.data();
  for (char** entry = ::environ; entry && *entry; ++entry) {
    if (std::string_view(*entry).starts_with(variable)) continue;
    if (count + 1 >= environment.size()) return false;
    environment[count++] = *entry;
  }
  environment[count] = nullptr;
  return true;
}

}  // namespace

const char* loading_with_its_folder() noexcept {
  static constexpr char call[] = "loading it";  // compared by address
  return call;
}

bool is_left_out(std::string_view library) {
  const char* value = std::getenv(name);
  std::string_view rest = value ? value : "";
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line == library) return true;
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
  }
  return false;
}

void start_again_without(const char* library, char* const* arguments) noexcept {
  std::size_t size = 0;
  const std::string_view before = left_out_so_far();
  if (!append(size, variable) || !append(size, before) || !append(size, before.empty() ? "" : "\n") ||
      !append(size, library) || !copy_environment())
    return;
  sigset_t mask;  // a handler's signal is blocked, and would still be in the new program
  sigemptyset(&mask);
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  ::execve("/proc/self/exe", arguments, environment.data());
}

}  // namespace trammel::plugin
