// Where a command's results go.
#pragma once

#include <filesystem>

#include "arguments.hpp"

namespace trammel::tool {

inline constexpr Option kOut{"--out", "DIR", "results folder; default out/<scene name>"};
inline constexpr Option kQuiet{"--quiet", "", "no progress, no summary"};

std::filesystem::path results_folder(const Arguments& arguments);
// Throws UsageError: found out before a long run starts, not at its first record.
void require_writable(const std::filesystem::path& folder);

}  // namespace trammel::tool
