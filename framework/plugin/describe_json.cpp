#include "plugin/describe_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "plugin/parameters.hpp"

namespace trammel::plugin {

namespace {

using Json = nlohmann::ordered_json;

void add_bound(Json& json, const char* name, double bound) {
  if (std::isfinite(bound)) json[name] = bound;
}

Json json_of(const Parameter& parameter, const ParameterValue& fallback) {
  const ParameterTraits& traits = parameter.traits;
  Json json = {{"name", parameter.name}, {"expects", expected(parameter)}, {"required", traits.required}};
  if (const std::string value = text(fallback); !traits.required && !value.empty()) {
    Json parsed = Json::parse(value, nullptr, false);  // infinity is no JSON
    json["default"] = parsed.is_discarded() ? Json(value) : std::move(parsed);
  }
  if (const std::string unit = traits.unit; !unit.empty()) json["unit"] = unit;
  add_bound(json, traits.above_min ? "above" : "min", traits.min);
  add_bound(json, "max", traits.max);
  add_bound(json, "usual_min", traits.usual_min);
  add_bound(json, "usual_max", traits.usual_max);
  if (!parameter.choices.empty()) json["choices"] = parameter.choices;
  if (*traits.doc) json["doc"] = traits.doc;
  return json;
}

Json keys_of(Kind kind) {
  Json keys = Json::array();
  for (const FrameworkKey& key : framework_keys(kind).subspan(1))
    keys.push_back({{"name", key.name}, {"doc", key.doc}});
  return keys;
}

}  // namespace

Json describe_json(const Entry& entry) {
  const Declaration& declaration = entry.declaration;
  Json parameters = Json::array();
  for (const Parameter& parameter : declaration.parameters)
    parameters.push_back(json_of(parameter, default_of(entry, parameter)));
  return {{"kind", to_string(declaration.kind)},
          {"name", declaration.name},
          {"summary", declaration.summary},
          {"source", declaration.source},
          {"file", entry.file},
          {"parameters", parameters},
          {"markers", declaration.markers},
          {"observables", declaration.observables},
          {"keys", keys_of(declaration.kind)}};
}

Json describe_json(const Part& part) {
  Json keys = Json::array();
  for (const Part::Key& key : part.keys) keys.push_back(json_of(key.declared, key.fallback));
  return {{"kind", "part of a scene"}, {"name", part.name},  {"summary", part.summary},
          {"example", part.example},   {"parameters", keys}, {"remarks", part.remarks}};
}

}  // namespace trammel::plugin
