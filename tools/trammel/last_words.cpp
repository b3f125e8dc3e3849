#include "last_words.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include "input.hpp"

namespace trammel::tool {

namespace {

// Handlers have no other way to reach the run.
simulate::CrashWitness the_witness;
bool as_json = false;

void put(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(std::size_t(n));
  }
}

void put_json(std::string_view message) {
  put(json_output(),
      R"({"status": "error", "problems": [{"file": "", "line": 0, "column": 0, "path": "", "message": ")");
  for (const char& c : message) {
    if (c == '"' || c == '\\') put(json_output(), "\\");
    put(json_output(), static_cast<unsigned char>(c) < 0x20 ? std::string_view(" ") : std::string_view(&c, 1));
  }
  put(json_output(), "\"}]}\n");
}

}  // namespace

simulate::CrashWitness& witness() {
  return the_witness;
}

void speak_json() {
  as_json = true;
}

void Line::add_culprit(const simulate::CrashWitness::Culprit& who) {
  add("plugin {}: ", who.origin->file);
  if (!who.origin->component.empty()) add("{}", who.origin->component);
  if (!who.origin->path.empty()) add(" ({})", who.origin->path);
  add("{}{}{}", who.origin->component.empty() ? "" : ": ", who.call,
      who.certain ? "" : ", or the program on its behalf");
}

void Line::add_time(const simulate::CrashWitness::Culprit& who) {
  if (who.t) add(" at t = {:.9g} s", *who.t);
  if (who.step) add(", step {}", *who.step);
}

void end_process(Exit code, const char* status, const Line& line) {
  the_witness.rescue(status, line.text());
  if (as_json) {
    put_json(line.text());
  } else {
    put(STDERR_FILENO, "trammel: ");
    put(STDERR_FILENO, line.text());
    put(STDERR_FILENO, "\n");
  }
  leave(static_cast<int>(code));
}

void leave(int code) {
  for (;;) ::syscall(SYS_exit_group, code);
}

}  // namespace trammel::tool
