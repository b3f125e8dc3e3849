// A report as one HTML file: style sheet, data and scripts, all inside of it.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "report/page.hpp"

namespace trammel::report {

// What the file needs in addition to the common scripts.
enum class Needs { page, runs };

// `data`: {"kind": ..., ...}, as assets/main.js reads it. Throws std::runtime_error if the program was built without
// dygraphs and `needs` are runs.
std::string html_file(const std::string& title, const nlohmann::ordered_json& data, Needs needs);

}  // namespace trammel::report
