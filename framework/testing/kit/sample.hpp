// Parameters for a component about which nothing is known but its declaration.
#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "testing/kit/subject.hpp"

namespace trammel::kit {

// The component's entry without anything that has a default: what is required gets a value inside its range.
// `attempt` chooses among the lengths that a list of numbers may have.
constexpr int attempts = 4;
nlohmann::ordered_json least_entry(const Declaration& declaration, Space space, int attempt = 0);

// A value inside the parameter's range; nothing where the declaration does not tell what would fit (free texts, parts).
std::optional<nlohmann::ordered_json> random_value(const Parameter& parameter, const ParameterValue& fallback,
                                                   Space space, std::mt19937& random);

// Sets a dotted name: "modes.axial" inside the object "modes".
void set_at(nlohmann::ordered_json& object, const std::string& dotted, nlohmann::ordered_json value);
const nlohmann::ordered_json* find_at(const nlohmann::ordered_json& object, const std::string& dotted);

// The forms in which a component is checked: `given` entries (each a JSON object, "space" may say "spatial"), else the
// least entry in the plane and in space, where the component accepts them; at level full also with each choice of its
// parameters. Throws std::runtime_error with the component's own words if it accepts none.
std::vector<Form> forms_of(const plugin::Entry& entry, const std::vector<std::string>& given, Level level);

}  // namespace trammel::kit
