// Reads the files of a scene.
#pragma once

#include <filesystem>
#include <string>

namespace trammel::scene {

// Reads the scene itself, which may be a pipe. Throws SceneError.
std::string read_file(const std::string& file);

// Reads a file that a scene names, an include or a table. It must be a regular file, because a pipe may hang and a
// device may never end. Throws SceneError.
std::string read_named_file(const std::string& file);

// Symbolic links are resolved first: a link to a target outside the folder counts as outside.
bool is_within(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace trammel::scene
