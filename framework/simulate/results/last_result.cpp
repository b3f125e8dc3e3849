#include "simulate/results/last_result.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace trammel::simulate {
namespace {

void put(int file, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(std::size_t(n));
  }
}

// As the inside of a JSON string.
void put_escaped(int file, std::string_view text) noexcept {
  for (const char& c : text) {
    if (c == '"' || c == '\\') put(file, "\\");
    put(file, static_cast<unsigned char>(c) < 0x20 ? std::string_view(" ") : std::string_view(&c, 1));
  }
}

}  // namespace

LastResult::LastResult(const std::filesystem::path& folder, nlohmann::ordered_json head)
    : file_((folder / "result.json").string()), temporary_(file_ + ".tmp") {
  for (const char* written_first : {"trammel_result", "status", "reason"}) head.erase(written_first);
  using json = nlohmann::ordered_json;
  rest_ = head.empty() ? "\n}\n" : "," + head.dump(2, ' ', false, json::error_handler_t::replace).substr(1) + "\n";
}

void LastResult::write(const char* status, std::string_view reason) const noexcept {
  ::unlink(temporary_.c_str());
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return;
  put(file, "{\n  \"trammel_result\": 1,\n  \"status\": \"");
  put(file, status);
  put(file, "\",\n  \"reason\": \"");
  put_escaped(file, reason);
  put(file, "\"");
  put(file, rest_);
  ::close(file);
  std::rename(temporary_.c_str(), file_.c_str());
}

}  // namespace trammel::simulate
