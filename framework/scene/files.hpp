// Reading the files that a scene consists of.
#pragma once

#include <filesystem>
#include <string>

namespace trammel::scene {

// The scene itself: a pipe may do. Throws SceneError.
std::string read_file(const std::string& file);

// What a scene names, an include or a table: a regular file alone, for a pipe may hang and a device never end. Throws SceneError.
std::string read_named_file(const std::string& file);

// Links are followed first: a link that leads out of the folder is outside.
bool is_within(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace trammel::scene
