// The last message of a process, and its end: for handlers of signals and of failed allocations. Nothing here
// allocates.
#pragma once

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "arguments.hpp"
#include "simulate/start/crash_witness.hpp"

namespace trammel::tool {

// The witness that handlers ask for the state of the run.
simulate::CrashWitness& witness();

// After this call the last words are a JSON object on standard output.
void speak_json();

// Text in a fixed place. What does not fit is cut off.
class Line {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    const auto end = fmt::format_to_n(text_.data() + size_, text_.size() - size_, format, std::forward<Args>(args)...);
    size_ = std::size_t(end.out - text_.data());
  }
  void add_culprit(const simulate::CrashWitness::Culprit& who);  // has an origin
  void add_time(const simulate::CrashWitness::Culprit& who);     // and step, as far as they are known
  std::string_view text() const { return {text_.data(), size_}; }

 private:
  std::array<char, 2048> text_;
  std::size_t size_ = 0;
};

// Writes the records, and result.json with `status` and the line as its reason; prints the line.
[[noreturn]] void end_process(Exit code, const char* status, const Line& line);

// Ends the process without destructors of globals and functions of atexit.
[[noreturn]] void leave(int code);

}  // namespace trammel::tool
