// JSON Schema of scenes: the structure of a scene, filled from the declarations. Editors use it for completion and
// checks; `trammel validate` checks more (names of markers, dimensions, expressions).
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "plugin/describe.hpp"
#include "plugin/parameters.hpp"

namespace trammel::plugin {

namespace {

using Json = nlohmann::ordered_json;

Json reference(const std::string& name) {
  return {{"$ref", "#/$defs/" + name}};
}
Json any_of(Json a, Json b) {
  return {{"anyOf", Json::array({std::move(a), std::move(b)})}};
}

Json object(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json keyed(Json member) {
  return {{"type", "object"}, {"additionalProperties", std::move(member)}};
}

Json with(Json schema, const std::string& description) {
  if (!description.empty()) schema["description"] = description;
  return schema;
}

// A number within the range, or an expression, which only the program can evaluate.
Json number(const char* type, const ParameterTraits& traits) {
  Json literal = {{"type", type}};
  if (std::isfinite(traits.min)) literal[traits.above_min ? "exclusiveMinimum" : "minimum"] = traits.min;
  if (std::isfinite(traits.max)) literal["maximum"] = traits.max;
  return any_of(std::move(literal), reference("expression"));
}

Json array_of(Json item) {
  return {{"type", "array"}, {"items", std::move(item)}};
}

Json vector(const ParameterTraits& traits) {
  Json schema = array_of(number("number", traits));
  schema["minItems"] = 2;
  schema["maxItems"] = 3;
  return schema;
}

Json part_schema(const Declaration& part);

Json type_of(const Parameter& parameter) {
  const ParameterTraits& traits = parameter.traits;
  switch (parameter.type) {
    case Parameter::Type::number:
      return number("number", traits);
    case Parameter::Type::time_function:
      return any_of(number("number", traits), reference("table"));
    case Parameter::Type::integer:
      return number("integer", traits);
    case Parameter::Type::boolean:
      return {{"type", "boolean"}};
    case Parameter::Type::text:
      if (parameter.choices.empty()) return {{"type", "string"}};
      return any_of({{"enum", parameter.choices}}, reference("expression"));
    case Parameter::Type::numbers:
      return any_of(number("number", traits), array_of(number("number", traits)));
    case Parameter::Type::vector:
      return vector(traits);
    case Parameter::Type::named_numbers:
      return keyed(number("number", traits));
    case Parameter::Type::named_vectors:
      return keyed(vector(traits));
    case Parameter::Type::named_parts:
      return keyed(part_schema(*parameter.part));
  }
  return Json::object();
}

Json default_value(const ParameterValue& value) {
  const Json json = Json::parse(text(value), nullptr, false);  // infinity cannot be written in JSON
  return json.is_discarded() ? Json() : json;
}

// `fallback` is called only if there is one.
template <class Fallback>
Json schema_of(const Parameter& parameter, Fallback fallback) {
  Json schema = type_of(parameter);
  const ParameterTraits& traits = parameter.traits;
  std::vector<std::string> notes;
  if (*traits.doc) notes.push_back(traits.doc);
  if (const std::string unit = traits.unit; !unit.empty() && unit != "1") notes.push_back("[" + unit + "]");
  if (traits.required) notes.push_back("(required)");
  const std::string description = fmt::format("{}", fmt::join(notes, " "));
  schema = with(std::move(schema), description);
  if (!traits.required)
    if (Json value = default_value(fallback()); !value.is_null()) schema["default"] = std::move(value);
  return schema;
}

// Schemas of a part that the program reads: of its object, and of the part if an object is optional.
Json schema_of(const std::vector<Part>& parts, const char* name) {
  for (const Part& part : parts) {
    if (part.name != name) continue;
    Json properties = Json::object();
    for (const Part::Key& key : part.keys)
      properties[key.declared.name] = schema_of(key.declared, [&] { return key.fallback; });
    return with(object(std::move(properties)), part.summary);
  }
  return {{"type", "object"}};
}

// Adds a parameter's schema to the nested object given by its dotted name.
void place(Json& object_schema, const std::string& dotted, Json schema) {
  const auto dot = dotted.find('.');
  Json& member = object_schema["properties"][dotted.substr(0, dot)];
  if (dot == std::string::npos) {
    member = std::move(schema);
    return;
  }
  if (member.is_null()) member = object(Json::object());
  place(member, dotted.substr(dot + 1), std::move(schema));
}

Json part_schema(const Declaration& part) {
  const std::unique_ptr<Component> defaults = part.make();
  Json schema = with(object(Json::object()), part.summary);
  for (const Parameter& parameter : part.parameters)
    place(schema, parameter.name, schema_of(parameter, [&] { return parameter.get(*defaults); }));
  return schema;
}

Json schema_of(const Entry& entry) {
  const Declaration& declaration = entry.declaration;
  Json properties = Json::object();
  for (const FrameworkKey& key : framework_keys(declaration.kind))
    properties[key.name] = key.name == "type" ? Json{{"const", declaration.name}} : with(reference(key.name), key.doc);
  const Kind kind = declaration.kind;
  if (kind == Kind::body || kind == Kind::joint || kind == Kind::force || kind == Kind::contact)
    properties["for"] = reference("for");
  Json schema = with(object(std::move(properties)), declaration.summary);
  for (const Parameter& parameter : declaration.parameters)
    place(schema, parameter.name, schema_of(parameter, [&] { return default_of(entry, parameter); }));
  return schema;
}

std::string definition(const Declaration& declaration) {
  return fmt::format("{}.{}", to_string(declaration.kind), declaration.name);
}

// Objects of one kind: "type" is one of the names; the other members are declared by that component.
Json choice_of(Kind kind, const std::vector<const Entry*>& entries) {
  Json names = Json::array(), cases = Json::array();
  for (const Entry* entry : entries) {
    const Declaration& declaration = entry->declaration;
    if (declaration.kind != kind) continue;
    names.push_back(declaration.name);
    cases.push_back({{"if", {{"properties", {{"type", {{"const", declaration.name}}}}}, {"required", {"type"}}}},
                     {"then", reference(definition(declaration))}});
  }
  Json schema = {{"type", "object"}};
  if (names.empty()) return schema;
  schema["properties"] = {{"type", {{"enum", std::move(names)}}}};
  schema["allOf"] = std::move(cases);
  return schema;
}

Json correction(const std::vector<const Entry*>& entries) {
  Json names = Json::array();
  for (const Entry* entry : entries)
    if (entry->declaration.kind == Kind::correction) names.push_back(entry->declaration.name);
  if (names.empty()) return {{"type", "string"}};
  return any_of({{"enum", std::move(names)}}, reference("correction"));
}

// Definitions that several places of a scene share.
void define_common(Json& definitions, const std::vector<Part>& parts) {
  const Json number = reference("number");
  definitions["expression"] =
      with({{"type", "string"}, {"pattern", "^="}}, "\"=...\", evaluated in the scene's parameters");
  definitions["number"] = any_of({{"type", "number"}}, reference("expression"));
  definitions["positive"] = any_of({{"type", "number"}, {"exclusiveMinimum", 0}}, reference("expression"));
  Json column = {{"type", {"string", "integer"}}};
  definitions["table"] = with(object({{"table", {{"type", "string"}}},
                                      {"time", column},
                                      {"column", column},
                                      {"holds", {{"enum", {"values", "accelerations"}}}},
                                      {"scale", number},
                                      {"beyond", {{"enum", {"hold", "zero", "repeat"}}}}}),
                              "a law of time from a text table, its columns by name or by number from 1");
  definitions["vector"] = array_of(number);
  Json frame = object({{"point", reference("vector")}, {"angle", number}, {"axis", reference("vector")}});
  definitions["marker"] = with(any_of({{"type", "string"}}, std::move(frame)),
                               "\"ground\", a body's marker such as \"beam.tip\", or a frame fixed in the world");
  definitions["on"] = reference("marker");
  Json plane = object({{"point", reference("vector")}, {"normal", reference("vector")}, {"on", reference("marker")}});
  definitions["between"] = array_of(any_of(
      reference("marker"), any_of(object({{"plane", std::move(plane)}}), object({{"surface", {{"type", "string"}}}}))));
  definitions["radius"] = number;
  definitions["between"]["minItems"] = 2;
  definitions["between"]["maxItems"] = 4;
  definitions["reaches"] = reference("joint");
  definitions["for"] =
      with(keyed(any_of(number, array_of(number))),
           "repeats this unit: {\"i\": n} counts 0 ... n - 1, {\"i\": [a, b]} a ... b; {i} in its texts");
  definitions["from"] = {{"enum", {"above", "below"}}};
  definitions["step"] = any_of(reference("positive"), schema_of(parts, "step"));
  definitions["contact_step"] = reference("step");
}

// The members that a scene requires unless it is included by another one; an editor requires them if "include" is
// missing.
Json complete(const std::vector<const Entry*>& entries) {
  Json groups = Json::object();
  for (const auto& [group, kind] : {std::pair{"bodies", Kind::body},
                                    {"joints", Kind::joint},
                                    {"forces", Kind::force},
                                    {"contacts", Kind::contact}}) {
    Json cases = Json::array();
    for (const Entry* entry : entries) {
      const Declaration& declaration = entry->declaration;
      Json names = Json::array();
      for (const Parameter& parameter : declaration.parameters)
        if (parameter.traits.required && parameter.name.find('.') == std::string::npos) names.push_back(parameter.name);
      if (declaration.kind == kind && !names.empty())
        cases.push_back({{"if", {{"properties", {{"type", {{"const", declaration.name}}}}}}},
                         {"then", {{"required", std::move(names)}}}});
    }
    Json member = {{"required", {"type"}}};
    if (!cases.empty()) member["allOf"] = std::move(cases);
    groups[group] = {{"additionalProperties", std::move(member)}};
  }
  groups["simulate"] = {{"required", {"until"}}};
  Json whole = {{"required", {"trammel", "bodies"}},
                {"anyOf", Json::array({{{"required", {"simulate"}}}, {{"required", {"static"}}}})},
                {"properties", std::move(groups)}};
  return {{"if", {{"required", {"include"}}}}, {"then", true}, {"else", std::move(whole)}};
}

}  // namespace

std::string schema(const std::vector<const Entry*>& entries, const std::vector<Part>& parts) {
  Json definitions = Json::object();
  define_common(definitions, parts);
  for (const Kind kind :
       {Kind::integrator, Kind::body, Kind::joint, Kind::force, Kind::contact, Kind::friction, Kind::correction})
    definitions[to_string(kind)] = choice_of(kind, entries);
  for (const Entry* entry : entries) definitions[definition(entry->declaration)] = schema_of(*entry);

  const Json text = {{"type", "string"}};
  const Json texts = array_of(text);
  Json properties;
  properties["trammel"] = with({{"const", 1}}, "version of the scene format");
  properties["$schema"] = with(text, "where an editor finds this schema: 'trammel schema > scene.schema.json'");
  properties["title"] = text;
  properties["description"] = text;
  properties["space"] = {{"enum", {"planar", "spatial"}}};
  properties["gravity"] = with(reference("vector"), "[m/s^2]");
  properties["plugins"] = with(texts,
                               "libraries and folders of libraries, relative to this file; loaded with "
                               "--allow-scene-plugins or from a folder that is searched anyway");
  properties["parameters"] = with(keyed({{"type", {"number", "string", "object"}}}), "names for expressions");
  properties["include"] = with(any_of(text, texts), "scenes that this one extends; this one wins");
  properties["bodies"] = keyed(reference("body"));
  properties["joints"] = keyed(reference("joint"));
  properties["forces"] = keyed(reference("force"));
  properties["contacts"] = keyed(reference("contact"));
  properties["integrator"] = reference("integrator");
  properties["initial"] = any_of({{"enum", {"check", "project", "equilibrium"}}},
                                 object({{"consistent", {{"enum", {"check", "project"}}}}}));
  properties["simulate"] = schema_of(parts, "simulate");
  properties["static"] = schema_of(parts, "static");
  properties["record"] = schema_of(parts, "record");
  properties["record"]["properties"]["observe"] =
      with(keyed(any_of(text, object({{"of", text}, {"relative_to", text}, {"since_start", {{"type", "boolean"}}}}))),
           "columns of series.csv by name");
  properties["corrections"] = object({{"position", correction(entries)},
                                      {"velocity", correction(entries)},
                                      {"energy", any_of({{"type", "boolean"}}, correction(entries))}});

  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Trammel scene"}};
  schema.update(object(std::move(properties)));
  schema.update(complete(entries));
  schema["$defs"] = std::move(definitions);
  return schema.dump(2);
}

}  // namespace trammel::plugin
