// The folder of a command's results.
#pragma once

#include <filesystem>

#include "arguments.hpp"
#include "simulate/results/results_folder.hpp"

namespace trammel::tool {

inline constexpr Option kOut{"--out", "DIR", "results folder; default out/<scene name>"};
inline constexpr Option kQuiet{"--quiet", "", "no progress, no summary"};

// --out, or out/<scene name> with an ending that keeps commands apart.
std::filesystem::path results_folder(const Arguments& arguments, const char* ending = "");

}  // namespace trammel::tool
