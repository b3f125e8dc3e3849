#include "simulate/log_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

constexpr std::size_t buffered = 1 << 16;  // bytes

std::string problem_of(const char* doing, const std::filesystem::path& path, int error) {
  return fmt::format("cannot {} {}: {}", doing, path.string(), std::strerror(error));
}

[[noreturn]] void fail(const char* doing, const std::filesystem::path& path, int error) {
  throw OutputError(problem_of(doing, path, error));
}

int open_file(const std::filesystem::path& path, int how) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | how, 0666);
  if (file < 0) fail("open", path, errno);
  return file;
}

// Returns how much was written; less than all of it: errno tells why.
std::size_t write_to(int file, std::string_view text) noexcept {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += std::size_t(n);
  }
  return done;
}

std::size_t whole_lines(std::string_view text) noexcept {
  const std::size_t newline = text.rfind('\n');
  return newline == text.npos ? 0 : newline + 1;
}

int shortened(const std::filesystem::path& path, long long keep) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail("continue", path, error.value());
  if (static_cast<long long>(size) < keep)
    throw OutputError(fmt::format("cannot continue {}: it has {} bytes, its checkpoint was written after {}",
                                  path.string(), size, keep));
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(keep), error);
  if (error) fail("shorten", path, error.value());
  return open_file(path, O_APPEND);
}

}  // namespace

Descriptor::~Descriptor() {
  ::close(number_);
}

LogFile::LogFile(const std::filesystem::path& path)
    : path_(path), file_(open_file(path, O_CREAT | O_TRUNC | O_APPEND)) {
  buffer_.reserve(buffered * 2);
}

LogFile::LogFile(const std::filesystem::path& path, long long keep)
    : path_(path), file_(shortened(path, keep)), length_(keep) {
  buffer_.reserve(buffered * 2);
}

LogFile::~LogFile() {
  flush();  // best effort: if it fails, the run has told so before
}

void LogFile::append(std::string_view text) {
  buffer_ += text;
  appended();
}

void LogFile::appended() {
  if (buffer_.size() >= buffered) flush();
}

bool LogFile::flush() {
  problem_.clear();
  const std::size_t written = write_to(file_.number(), buffer_);
  if (written == buffer_.size()) {
    length_ += static_cast<long long>(written);
    buffer_.clear();
    return true;
  }
  problem_ = problem_of("write to", path_, errno ? errno : EIO);
  std::size_t lines = whole_lines(std::string_view(buffer_).substr(0, written));
  // The part of a line that stands there goes; if even that fails, it stays and is not written twice.
  if (::ftruncate(file_.number(), length_ + static_cast<long long>(lines)) != 0) lines = written;
  length_ += static_cast<long long>(lines);
  buffer_.erase(0, lines);
  return false;
}

long long LogFile::unwritten_lines() const {
  return std::count(buffer_.begin(), buffer_.end(), '\n');
}

void LogFile::rescue() const noexcept {
  write_to(file_.number(), std::string_view(buffer_).substr(0, whole_lines(buffer_)));
}

Reserve::Reserve(const std::filesystem::path& folder, long long bytes)
    : file_(open_file(folder / ".reserve", O_CREAT | O_TRUNC)) {
  ::unlink((folder / ".reserve").c_str());
  if (::posix_fallocate(file_.number(), 0, bytes) == ENOSPC)
    throw OutputError(fmt::format("cannot write results to {}: no space left on the disk; at least {} KiB must be free",
                                  folder.string(), (bytes + 1023) / 1024));
}

void write_whole(const std::filesystem::path& path, std::string_view content) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  int error = 0;
  {
    const Descriptor file(open_file(temporary, O_CREAT | O_TRUNC));
    errno = 0;
    if (write_to(file.number(), content) != content.size()) error = errno ? errno : EIO;
  }
  if (error) {
    std::remove(temporary.c_str());
    fail("write to", path, error);
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("rename into place", path, errno);
}

}  // namespace trammel::simulate
