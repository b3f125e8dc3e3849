// A line of a table of numbers and plain words.
#pragma once

#include <string>
#include <vector>

namespace trammel::report {

// Separated by commas; nothing is quoted in the tables of a results folder.
std::vector<std::string> cells_of(const std::string& line);

}  // namespace trammel::report
