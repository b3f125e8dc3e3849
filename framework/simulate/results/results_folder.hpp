// The folder of one command's results.
//
// While a command lives, the folder is locked: a second one is refused, or both would write one set of files. Nobody is led away
// by a symbolic link. A new run removes what an older run of the same command left there, and nothing else: the default folder
// is named by the scene, and to run it again is the common way of work. Another command's results are refused.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "simulate/results/log_file.hpp"

namespace trammel::simulate {

inline constexpr const char* newest_checkpoint = "checkpoint.cbor";
inline constexpr const char* checkpoint_before = "checkpoint.previous.cbor";

// Results cannot go there: names the folder and why. Exit code 2.
class FolderRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Analysis { motion, statics, modes };

class ResultsFolder {
 public:
  // Makes the folder if it is missing, and locks it until the end. Throws FolderRefused.
  ResultsFolder(const std::filesystem::path& folder, Analysis analysis);
  // Folders that were made for nothing go: an invalid scene leaves none.
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

 private:
  struct Made {
    std::vector<std::filesystem::path> folders;  // outermost first
    ~Made();
  };
  Made made_;
  Descriptor lock_;
};

// Removes every file that a command writes, also half-written ones; what else is there stays. Throws OutputError.
void remove_results(const std::filesystem::path& folder);

}  // namespace trammel::simulate
