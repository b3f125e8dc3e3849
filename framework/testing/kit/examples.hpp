// Parameters for the shipped components that have required ones, and checks that they fail for a reason: examples.json,
// built into the program.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace trammel::kit {

struct Example {
  std::vector<std::string> entries;             // JSON objects as in a scene; empty: made up from the declaration
  std::map<std::string, std::string> expected;  // check: reason
};
Example example_of(const std::string& kind, const std::string& name);

}  // namespace trammel::kit
