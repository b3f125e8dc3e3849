// `trammel report`: results as one HTML file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace trammel::report {

// The argument cannot be reported; the text states why, and what can be. Exit code 2.
class ReportRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A report on results folders, or on a JSON file with a "page". Several runs are overlaid; other results are reported
// one at a time. Throws ReportRefused, and std::runtime_error for a damaged file.
std::string report(const std::vector<std::filesystem::path>& what);

}  // namespace trammel::report
