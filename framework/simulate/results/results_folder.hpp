// The folder of one command's results.
//
// While a command runs, the folder is locked: a second command is refused, because both would write the same files.
// Symbolic links are not followed. A new run removes the results of an older run of the same command and nothing else:
// the default folder is named after the scene, and scenes are run repeatedly. Results of another command are refused.
// So are files with the names of results in a folder without any sign of a run: they belong to somebody else.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "simulate/results/log_file.hpp"

namespace trammel::simulate {

inline constexpr const char* newest_checkpoint = "checkpoint.cbor";
inline constexpr const char* checkpoint_before = "checkpoint.previous.cbor";

// Results cannot be written there. The text names the folder and the reason. Exit code 2.
class FolderRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Analysis { motion, statics, modes, study, trade };

class ResultsFolder {
 public:
  // Makes the folder if it is missing, and locks it until the end. Throws FolderRefused.
  ResultsFolder(const std::filesystem::path& folder, Analysis analysis);
  // Removes the folders that were made: an invalid scene leaves none.
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

// Throws FolderRefused if the folder is a symbolic link, or if it contains files that this command would remove or
// overwrite and nothing shows that they are of an older run.
void refuse_files_of_others(const std::filesystem::path& folder, Analysis analysis);

// True if something in the folder shows that a command of this program wrote there.
bool shows_results(const std::filesystem::path& folder);

// Removes every file that a command writes, also half-written ones, and no others. Throws OutputError.
void remove_results(const std::filesystem::path& folder);

}  // namespace trammel::simulate
