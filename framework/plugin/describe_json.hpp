// Manual pages as JSON, from the declarations alone.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "plugin/describe.hpp"

namespace trammel::plugin {

// An object with kind, name, summary, source, file, parameters, markers, observables and keys. Each parameter has its
// name, what is expected, default, unit, limits, choices and doc.
nlohmann::ordered_json describe_json(const Entry& entry);
nlohmann::ordered_json describe_json(const Part& part);

}  // namespace trammel::plugin
