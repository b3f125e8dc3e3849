// A JSON file of a results folder.
#pragma once

#include <filesystem>
#include <initializer_list>

#include <nlohmann/json.hpp>

namespace trammel::report {

// Throws std::runtime_error naming the file and, if it is not JSON, line and column of the error.
nlohmann::ordered_json json_file(const std::filesystem::path& file);

// The value at a path of keys; null: there is none.
const nlohmann::ordered_json* find(const nlohmann::ordered_json& root, std::initializer_list<const char*> path);

}  // namespace trammel::report
