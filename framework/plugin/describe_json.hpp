// Manual pages as JSON, from the declarations alone.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "plugin/describe.hpp"

namespace trammel::plugin {

// kind, name, summary, source, file, markers, observables, keys, and of each parameter name, what is expected, default,
// unit, limits, choices and doc.
nlohmann::ordered_json describe_json(const Entry& entry);
nlohmann::ordered_json describe_json(const Part& part);

}  // namespace trammel::plugin
