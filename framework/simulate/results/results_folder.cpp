#include "simulate/results/results_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace trammel::simulate {
namespace {

namespace fs = std::filesystem;

constexpr std::array written = {"series.csv",  "events.csv",          "animation.ndjson", "fields.ndjson",
                                "result.json", "scene.resolved.json", "modes.json",       "modes.csv",
                                "shapes.csv",  newest_checkpoint,     checkpoint_before, "report.html",
                                "series.npz",  "events.npz",          "animation.pvd",    "fields.pvd"};

constexpr std::array commands = {"trammel run", "trammel static", "trammel modes", "trammel study", "trammel trade"};

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw FolderRefused(fmt::format("cannot write results to {}: {}; --out names another folder", folder.string(), why));
}

// "out/" is a folder without a name of its own.
fs::path without_slash(fs::path folder) {
  return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

std::vector<fs::path> make(const fs::path& folder) {
  std::vector<fs::path> missing, made;
  std::error_code error;
  for (fs::path at = folder; !at.empty() && !fs::exists(fs::symlink_status(at, error)); at = at.parent_path())
    missing.push_back(at);
  for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
    if (::mkdir(at->c_str(), 0777) == 0)
      made.push_back(*at);
    else if (const int why = errno; why != EEXIST)  // another run may have made it meanwhile
      refuse(folder, std::strerror(why));
  }
  return made;
}

int open_locked(const fs::path& folder) {
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(folder, error)))
    refuse(folder, "it is a symbolic link; name the folder that it leads to");
  const int number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (number < 0) refuse(folder, std::strerror(errno));
  const auto close_and_refuse = [&](const char* why) {
    ::close(number);
    refuse(folder, why);
  };
  if (::access(folder.c_str(), W_OK | X_OK) != 0) close_and_refuse(std::strerror(errno));
  // File systems that know no locks give none.
  if (::flock(number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    close_and_refuse("another run writes there at this moment");
  return number;
}

std::optional<Analysis> analysis_in(const fs::path& folder) {
  std::error_code error;
  for (const auto& [name, analysis] :
       {std::pair("modes.json", Analysis::modes), std::pair("study.json", Analysis::study),
        std::pair("trade.json", Analysis::trade)})
    if (fs::exists(folder / name, error)) return analysis;
  const fs::path file = folder / "result.json";
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return std::nullopt;
  std::ifstream in(file);
  const nlohmann::json result = nlohmann::json::parse(in, nullptr, false);
  if (!result.is_object()) return std::nullopt;
  const auto analysis = result.find("analysis");
  return analysis != result.end() && *analysis == "static" ? Analysis::statics : Analysis::motion;
}

}  // namespace

ResultsFolder::Made::~Made() {
  for (auto at = folders.rbegin(); at != folders.rend(); ++at) ::rmdir(at->c_str());  // if empty
}

ResultsFolder::ResultsFolder(const fs::path& folder, Analysis analysis)
    : made_{make(without_slash(folder))}, lock_(open_locked(without_slash(folder))) {
  const auto there = analysis_in(folder);
  if (there && *there != analysis)
    refuse(folder, fmt::format("it holds results of '{}'", commands[std::size_t(*there)]));
}

ResultsFolder::~ResultsFolder() = default;

void remove_results(const fs::path& folder) {
  for (const char* name : written)
    for (const char* ending : {"", ".tmp"}) {
      std::error_code error;
      const fs::path file = folder / (std::string(name) + ending);
      if (!fs::exists(fs::symlink_status(file, error))) continue;
      if (!fs::remove(file, error) || error)
        throw OutputError(fmt::format("cannot remove {} of an older run: {}", file.string(), error.message()));
    }
}

}  // namespace trammel::simulate
