// Texts about components, from their declarations alone.
#pragma once

#include <string>
#include <vector>

#include "plugin/registry.hpp"

namespace trammel::plugin {

std::string describe(const Entry& entry);                      // the manual page of `trammel describe NAME`
std::string list(const std::vector<const Entry*>& entries);    // `trammel list`: a line each, by kind
std::string schema(const std::vector<const Entry*>& entries);  // JSON Schema (draft 2020-12) of scenes made of these

// For messages, manual and schema alike.
std::string range(double min, bool above_min, double max);  // "> 0", "0 to 1", "" if anything goes
std::string expected(const Parameter& parameter);           // "a number > 0 [m]", "one of \"none\", \"full\""
std::string text(const ParameterValue& value);              // as it would stand in a scene; "" for none
ParameterValue default_of(const Entry& entry, const Parameter& parameter);

}  // namespace trammel::plugin
