#include "scene/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include <fmt/format.h>

#include "scene/limits.hpp"
#include "scene/no_memory.hpp"
#include "scene/value.hpp"

namespace trammel::scene {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, std::string message) {
  throw SceneError({{{file, 0, 0}, "", std::move(message)}});
}

struct Opened {
  int number;
  ~Opened() { ::close(number); }
};

std::string read(const std::string& file, bool regular) {
  // Do not wait for the other end of a pipe.
  const Opened opened{::open(file.c_str(), O_RDONLY | O_CLOEXEC | (regular ? O_NONBLOCK : 0))};
  if (opened.number < 0) require_memory(errno);
  if (opened.number < 0) fail(file, errno == ENOENT ? "no such file" : "cannot be opened for reading");
  struct stat status = {};
  if (::fstat(opened.number, &status) != 0) fail(file, "cannot be read");
  if (S_ISDIR(status.st_mode))
    fail(file, regular ? "is a directory, expected a file" : "is a directory, expected a scene file");
  if (regular && !S_ISREG(status.st_mode)) fail(file, "is a pipe or a device, expected a regular file");
  if (S_ISREG(status.st_mode) && status.st_size > off_t(limits::bytes))
    fail(file, fmt::format("has {} bytes; a scene has at most {} (64 MiB)", status.st_size, limits::bytes));
  std::string text;
  char block[1 << 16];
  for (;;) {
    const ssize_t n = ::read(opened.number, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(file, "cannot be read");
    if (n == 0) return text;
    text.append(block, std::size_t(n));
    if (text.size() > limits::bytes) fail(file, fmt::format("is longer than {} bytes (64 MiB)", limits::bytes));
  }
}

}  // namespace

std::string read_file(const std::string& file) {
  return read(file, false);
}

std::string read_named_file(const std::string& file) {
  return read(file, true);
}

bool is_within(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path outer = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path inner = fs::weakly_canonical(file, error);
  if (error) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace trammel::scene
