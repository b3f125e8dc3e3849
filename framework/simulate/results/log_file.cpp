#include "simulate/results/log_file.hpp"

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
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | how, 0666);
  if (file < 0) fail("open", path, errno);
  return file;
}

// Returns the number of bytes written; if it is less than asked for, errno has the reason.
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

LogPart extended(const LogPart& part, std::string_view text) {
  scene::FnvHash sum = scene::FnvHash::from(part.checksum);
  sum.bytes(text.data(), text.size());
  return {part.bytes + static_cast<long long>(text.size()), sum.value()};
}

std::size_t whole_lines(std::string_view text) noexcept {
  const std::size_t newline = text.rfind('\n');
  return newline == text.npos ? 0 : newline + 1;
}

int shortened(const std::filesystem::path& path, long long keep) {
  const int file = open_file(path, O_APPEND);
  if (::ftruncate(file, keep) == 0) return file;
  const int error = errno;
  ::close(file);
  fail("shorten", path, error);
}

// Opens a file that is new: removes whatever has this name, also a link.
int new_file(const std::filesystem::path& path) {
  ::unlink(path.c_str());
  return open_file(path, O_CREAT | O_EXCL);
}

// 0 or the error. A file system that cannot synchronise is no error.
int sync_to_disk(int file) {
  return ::fdatasync(file) == 0 || errno == EINVAL || errno == EROFS || errno == ENOSYS ? 0 : errno;
}

// Synchronises the folder's entries.
void sync_folder(const std::filesystem::path& folder) {
  const int number = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (number < 0) return;
  const Descriptor opened(number);
  if (const int error = sync_to_disk(number)) fail("write to", folder, error);
}

}  // namespace

Descriptor::~Descriptor() {
  ::close(number_);
}

LogFile::LogFile(const std::filesystem::path& path)
    : path_(path), file_(open_file(path, O_CREAT | O_TRUNC | O_APPEND)) {
  buffer_.reserve(buffered * 2);
}

LogFile::LogFile(const std::filesystem::path& path, const LogPart& keep)
    : path_(path), file_(shortened(path, keep.bytes)), written_(keep) {
  buffer_.reserve(buffered * 2);
}

LogFile::~LogFile() {
  flush();  // best effort: the run has reported a failure before
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
    written_ = part();
    buffer_.clear();
    return true;
  }
  problem_ = problem_of("write to", path_, errno ? errno : EIO);
  std::size_t lines = whole_lines(std::string_view(buffer_).substr(0, written));
  // Removes the part of a line that was written; if even that fails, it stays and is not written twice.
  if (::ftruncate(file_.number(), written_.bytes + static_cast<long long>(lines)) != 0) lines = written;
  written_ = extended(written_, std::string_view(buffer_).substr(0, lines));
  buffer_.erase(0, lines);
  return false;
}

LogPart LogFile::part() const {
  return extended(written_, buffer_);
}

bool LogFile::sync() {
  if (!flush()) return false;
  if (const int error = sync_to_disk(file_.number())) problem_ = problem_of("write to", path_, error);
  return problem_.empty();
}

long long LogFile::unwritten_lines() const {
  return std::count(buffer_.begin(), buffer_.end(), '\n');
}

void LogFile::rescue() const noexcept {
  write_to(file_.number(), std::string_view(buffer_).substr(0, whole_lines(buffer_)));
}

Reserve::Reserve(const std::filesystem::path& folder, long long bytes) : file_(new_file(folder / ".reserve")) {
  ::unlink((folder / ".reserve").c_str());
  if (::posix_fallocate(file_.number(), 0, bytes) == ENOSPC)
    throw OutputError(fmt::format("cannot write results to {}: no space left on the disk; at least {} KiB must be free",
                                  folder.string(), (bytes + 1023) / 1024));
}

std::string damage_of(const std::filesystem::path& path, const LogPart& part) {
  const int number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (number < 0) return problem_of("open", path, errno);
  const Descriptor file(number);
  LogPart found;
  char block[1 << 16];
  while (found.bytes < part.bytes) {
    const auto most = std::min<long long>(sizeof block, part.bytes - found.bytes);
    const ssize_t n = ::read(number, block, std::size_t(most));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return problem_of("read", path, errno);
    if (n == 0)
      return fmt::format("{} has {} bytes, but {} were written before the checkpoint", path.string(), found.bytes,
                         part.bytes);
    found = extended(found, {block, std::size_t(n)});
  }
  if (found.bytes == part.bytes && found.checksum == part.checksum) return "";
  return fmt::format("the first {} bytes of {} are not those that were written before the checkpoint", part.bytes,
                     path.string());
}

void write_whole(const std::filesystem::path& path, std::string_view content, const std::filesystem::path& before) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  int error = 0;
  {
    const Descriptor file(new_file(temporary));
    errno = 0;
    if (write_to(file.number(), content) != content.size())
      error = errno ? errno : EIO;
    else
      error = sync_to_disk(file.number());
  }
  if (error) {
    std::remove(temporary.c_str());
    fail("write to", path, error);
  }
  if (!before.empty() && std::rename(path.c_str(), before.c_str()) != 0 && errno != ENOENT) fail("rename", path, errno);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("rename into place", path, errno);
  sync_folder(path.parent_path());
}

}  // namespace trammel::simulate
