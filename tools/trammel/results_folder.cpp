#include "results_folder.hpp"

#include <cerrno>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace trammel::tool {

namespace fs = std::filesystem;

fs::path results_folder(const Arguments& arguments) {
  return arguments.has("--out") ? fs::path(arguments.last("--out"))
                                : fs::path("out") / fs::path(arguments.operand()).stem();
}

void require_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error && access(folder.c_str(), W_OK | X_OK) != 0) error = {errno, std::generic_category()};
  if (error)
    throw UsageError(
        fmt::format("cannot write results to {}: {}; --out names another folder", folder.string(), error.message()));
}

}  // namespace trammel::tool
