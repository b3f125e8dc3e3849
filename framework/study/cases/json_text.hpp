// A value of a scene as JSON text with unevaluated expressions, as `--set` takes it.
#pragma once

#include <string>

#include "scene/value.hpp"

namespace trammel::study {

std::string json_text(const scene::Value& value);
// "theta" of "\"theta\"", other JSON as it is.
std::string without_quotes(const std::string& json_text);

}  // namespace trammel::study
