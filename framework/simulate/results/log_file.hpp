// Files of the results folder: append-only logs that survive a kill, and files that are renamed into place when
// complete. Symbolic links are not followed: otherwise another user with write access to the folder could choose which
// files are overwritten.
//
// If the disk is full, only lines that are not yet written are lost, never half a line or a line already written: a log
// removes the line that it could not finish, keeps the rest in memory, and may try again. A Reserve keeps room for the
// end.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scene/fnv_hash.hpp"

namespace trammel::simulate {

// A result could not be written. The text names the file and the system's reason.
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

// The length of a log, and a checksum of it, at the time of a checkpoint.
struct LogPart {
  long long bytes = 0;
  std::uint64_t checksum = scene::FnvHash().value();
};

class LogFile {
 public:
  // Starts a new file, or continues an existing one after its part `keep`.
  explicit LogFile(const std::filesystem::path& path);
  LogFile(const std::filesystem::path& path, const LogPart& keep);
  ~LogFile();

  void append(std::string_view text);        // whole lines
  std::string& buffer() { return buffer_; }  // to format into; then call `appended`
  // Writes the buffer if it is full. Does not throw, so that a record is at least complete in memory; see `problem`.
  void appended();
  bool flush();                                            // false: see `problem`; the rest is kept for another try
  const std::string& problem() const { return problem_; }  // of the last try to write; empty: none
  std::string name() const { return path_.filename().string(); }
  long long unwritten_lines() const;
  LogPart part() const;  // all of it, written or not
  bool sync();           // `flush`, and the file survives a loss of power
  // Writes the buffer up to the last whole line. Safe in a signal handler.
  void rescue() const noexcept;

 private:
  std::filesystem::path path_;
  Descriptor file_;
  std::string buffer_, problem_;
  LogPart written_;
};

// Room on the disk, taken when a run starts and given back when the disk is full, so that the last lines, the
// checkpoint and the result still fit. The reserving file has no name in the folder and vanishes with the process.
class Reserve {
 public:
  // Throws OutputError if there is less room. A file system that cannot reserve room is no error.
  Reserve(const std::filesystem::path& folder, long long bytes);

 private:
  Descriptor file_;
};

// Why a log no longer begins with this part, as after a loss of power; empty: it does.
std::string damage_of(const std::filesystem::path& path, const LogPart& part);

// Writes a temporary file beside `path` and renames it: readers see the old or the new content, nothing between, also
// after a loss of power. With `before` the old content stays under that name.
void write_whole(const std::filesystem::path& path, std::string_view content, const std::filesystem::path& before = {});

}  // namespace trammel::simulate
