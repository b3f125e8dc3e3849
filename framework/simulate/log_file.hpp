// Files of the results folder: append-only logs that survive a kill, and files that are renamed into place when complete.
//
// A disk that fills up costs the lines that are not yet written, never a half line nor what stands already: a log gives back
// the line it could not finish, keeps what is left in memory, and may be tried again. A Reserve holds room for the end.
#pragma once

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

// An open file, closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

class LogFile {
 public:
  // Starts a new file, or goes on after its first `keep` bytes.
  explicit LogFile(const std::filesystem::path& path);
  LogFile(const std::filesystem::path& path, long long keep);
  ~LogFile();

  void append(std::string_view text);        // whole lines
  std::string& buffer() { return buffer_; }  // to format into; then `appended`
  // Writes a full buffer. Throws nothing, so that a record is complete in memory at least; `problem` tells.
  void appended();
  bool flush();  // false: `problem` tells, and what could not be written is kept for another try
  const std::string& problem() const { return problem_; }  // of the last try to write; empty: none
  std::string name() const { return path_.filename().string(); }
  long long unwritten_lines() const;
  long long length() const { return length_ + static_cast<long long>(buffer_.size()); }
  // What is left goes out as far as the last whole line. Calls nothing that a signal handler must not.
  void rescue() const noexcept;

 private:
  std::filesystem::path path_;
  Descriptor file_;
  std::string buffer_, problem_;
  long long length_ = 0;  // [bytes] written
};

// Room on the disk, taken when a run starts and given back when the disk is full, so that the last lines, the checkpoint and
// the result still find some. It has no name in the folder and vanishes with the process.
class Reserve {
 public:
  // Throws OutputError if there is less room; a file system that cannot promise room gives none and is no error.
  Reserve(const std::filesystem::path& folder, long long bytes);

 private:
  Descriptor file_;
};

// Writes a temporary file beside `path` and renames it: readers see the old content or the new, nothing between.
void write_whole(const std::filesystem::path& path, std::string_view content);

}  // namespace trammel::simulate
