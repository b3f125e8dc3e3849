// `trammel report`: results as one HTML file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace trammel::report {

// What was named cannot be reported: says why, and what can be. Exit code 2.
class ReportRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The report on results folders, or on a JSON file with a "page". Several runs are overlaid; others come one at a time.
// Throws ReportRefused, and std::runtime_error for a file that is damaged.
std::string report(const std::vector<std::filesystem::path>& what);

}  // namespace trammel::report
