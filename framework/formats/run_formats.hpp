// `trammel run --format NAME`: converts the results for another tool.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace trammel::formats {

struct RunFormat {
  std::string_view name, summary;
  // Writes beside the results in `folder`; returns the file to open. Throws std::runtime_error.
  std::filesystem::path (*write)(const std::filesystem::path& folder);
};
std::span<const RunFormat> run_formats();
const RunFormat* find_run_format(std::string_view name);  // null: there is none

std::filesystem::path write_npz(const std::filesystem::path& folder);
std::filesystem::path write_vtu(const std::filesystem::path& folder);

}  // namespace trammel::formats
