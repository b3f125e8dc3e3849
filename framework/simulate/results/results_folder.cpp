#include "simulate/results/results_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace trammel::simulate {
namespace {

namespace fs = std::filesystem;

constexpr std::array written = {"series.csv",  "events.csv",          "animation.ndjson", "fields.ndjson",
                                "result.json", "scene.resolved.json", "modes.json",       "modes.csv",
                                "shapes.csv",  newest_checkpoint,     checkpoint_before,  "report.html",
                                "series.npz",  "events.npz",          "animation.pvd",    "fields.pvd"};

constexpr std::array of_study = {"study.json", "study.csv", "study.npz", "cases.ndjson"};
constexpr std::array of_trade = {"trade.json", "trade.csv", "choice.json", "scene.chosen.json"};

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

void refuse_link(const fs::path& folder) {
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(folder, error)))
    refuse(folder, "it is a symbolic link; name the folder that it leads to");
}

int open_locked(const fs::path& folder) {
  refuse_link(folder);
  const int number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (number < 0) refuse(folder, std::strerror(errno));
  const auto close_and_refuse = [&](const char* why) {
    ::close(number);
    refuse(folder, why);
  };
  if (::access(folder.c_str(), W_OK | X_OK) != 0) close_and_refuse(std::strerror(errno));
  // Some file systems know no locks and give none.
  if (::flock(number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    close_and_refuse("another run writes there at this moment");
  return number;
}

std::span<const char* const> written_by(Analysis analysis) {
  if (analysis == Analysis::study) return of_study;
  if (analysis == Analysis::trade) return of_trade;
  return written;
}

nlohmann::json json_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return {};
  std::ifstream in(file);
  return nlohmann::json::parse(in, nullptr, false);
}

bool is_checkpoint(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return false;
  constexpr int key_and_value = 64;  // in the order of their names; holds the last entry
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  in.seekg(std::max<std::streamoff>(0, std::streamoff(in.tellg()) - key_and_value));
  return std::string(std::istreambuf_iterator<char>(in), {}).find("trammel_checkpoint") != std::string::npos;
}

std::optional<Analysis> analysis_in(const fs::path& folder) {
  std::error_code error;
  for (const auto& [name, analysis] :
       {std::pair("modes.json", Analysis::modes), std::pair("study.json", Analysis::study),
        std::pair("trade.json", Analysis::trade)})
    if (fs::exists(folder / name, error)) return analysis;
  const nlohmann::json result = json_of(folder / "result.json");
  if (!result.is_object()) return std::nullopt;
  const auto analysis = result.find("analysis");
  return analysis != result.end() && *analysis == "static" ? Analysis::statics : Analysis::motion;
}

}  // namespace

// Each command begins by writing one of these files, so a folder of a killed command has one, too.
bool shows_results(const fs::path& folder) {
  for (const auto& [name, key] : {std::pair("scene.resolved.json", "trammel"),
                                  std::pair("result.json", "trammel_result"), std::pair("modes.json", "trammel_result"),
                                  std::pair("study.json", "trammel_study"), std::pair("trade.json", "trammel_trade")}) {
    const nlohmann::json content = json_of(folder / name);
    if (content.is_object() && content.contains(key)) return true;
  }
  return is_checkpoint(folder / newest_checkpoint) || is_checkpoint(folder / checkpoint_before);
}

ResultsFolder::Made::~Made() {
  for (auto at = folders.rbegin(); at != folders.rend(); ++at) ::rmdir(at->c_str());  // if empty
}

ResultsFolder::ResultsFolder(const fs::path& folder, Analysis analysis)
    : made_{make(without_slash(folder))}, lock_(open_locked(without_slash(folder))) {
  refuse_files_of_others(folder, analysis);
  const auto there = analysis_in(folder);
  if (there && *there != analysis)
    refuse(folder, fmt::format("it holds results of '{}'", commands[std::size_t(*there)]));
}

ResultsFolder::~ResultsFolder() = default;

void refuse_files_of_others(const fs::path& folder, Analysis analysis) {
  refuse_link(without_slash(folder));
  std::vector<std::string> lost;
  for (const char* name : written_by(analysis))
    if (std::error_code error; fs::exists(fs::symlink_status(folder / name, error))) lost.push_back(name);
  if (lost.empty() || shows_results(folder)) return;
  refuse(folder, fmt::format("'{}' would delete or overwrite {} there, and nothing in the folder shows that an older "
                             "run wrote {}; move {} away if the folder is the right one",
                             commands[std::size_t(analysis)], fmt::join(lost, ", "), lost.size() > 1 ? "them" : "it",
                             lost.size() > 1 ? "them" : "it"));
}

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
