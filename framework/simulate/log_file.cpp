#include "simulate/log_file.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

constexpr std::size_t buffered = 1 << 16;  // bytes

[[noreturn]] void fail(const char* doing, const std::filesystem::path& path, int error) {
  throw OutputError(fmt::format("cannot {} {}: {}", doing, path.string(), std::strerror(error)));
}

std::FILE* open(const std::filesystem::path& path, const char* mode) {
  std::FILE* file = std::fopen(path.c_str(), mode);
  if (!file) fail("open", path, errno);
  std::setvbuf(file, nullptr, _IONBF, 0);  // the buffer is ours, so that only whole lines are handed on
  return file;
}

void write(std::FILE* file, std::string_view text, const std::filesystem::path& path) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size()) fail("write to", path, errno ? errno : EIO);
}

}  // namespace

LogFile::LogFile(const std::filesystem::path& path) : path_(path), file_(open(path, "wb")) {
  buffer_.reserve(buffered * 2);
}

LogFile::LogFile(const std::filesystem::path& path, long long keep) : path_(path), length_(keep) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail("continue", path, error.value());
  if (static_cast<long long>(size) < keep)
    throw OutputError(fmt::format("cannot continue {}: it has {} bytes, its checkpoint was written after {}",
                                  path.string(), size, keep));
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(keep), error);
  if (error) fail("shorten", path, error.value());
  file_ = open(path, "ab");
  buffer_.reserve(buffered * 2);
}

LogFile::~LogFile() {
  if (!buffer_.empty() && file_)
    std::fwrite(buffer_.data(), 1, buffer_.size(), file_);  // best effort: an error was thrown before
  if (file_) std::fclose(file_);
}

void LogFile::append(std::string_view text) {
  buffer_ += text;
  appended();
}

void LogFile::appended() {
  if (buffer_.size() >= buffered) flush();
}

void LogFile::flush() {
  const std::size_t size = buffer_.size();
  try {
    write(file_, buffer_, path_);
  } catch (...) {
    buffer_.clear();  // not to be tried again on the way out
    throw;
  }
  length_ += static_cast<long long>(size);
  buffer_.clear();
}

void write_whole(const std::filesystem::path& path, std::string_view content) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  std::FILE* file = open(temporary, "wb");
  try {
    write(file, content, temporary);
  } catch (...) {
    std::fclose(file);
    std::remove(temporary.c_str());
    throw;
  }
  if (std::fclose(file) != 0) fail("write to", temporary, errno);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("rename into place", path, errno);
}

}  // namespace trammel::simulate
