// Files of the results folder: append-only logs that survive a kill, and files that are renamed into place when complete.
#pragma once

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace trammel::simulate {

// A result could not be written: names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class LogFile {
 public:
  // Starts a new file, or goes on after its first `keep` bytes.
  explicit LogFile(const std::filesystem::path& path);
  LogFile(const std::filesystem::path& path, long long keep);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  void append(std::string_view text);        // whole lines
  std::string& buffer() { return buffer_; }  // to format into; then `appended`
  void appended();
  void flush();
  long long length() const { return length_ + static_cast<long long>(buffer_.size()); }

 private:
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
  long long length_ = 0;  // written
};

// Writes a temporary file beside `path` and renames it: readers see the old content or the new, nothing between.
void write_whole(const std::filesystem::path& path, std::string_view content);

}  // namespace trammel::simulate
