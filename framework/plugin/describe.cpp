#include "plugin/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plugin/guard.hpp"
#include "plugin/parameters.hpp"

namespace trammel::plugin {

namespace {

const char* noun(Parameter::Type type) {
  switch (type) {
    case Parameter::Type::number:
      return "a number";
    case Parameter::Type::integer:
      return "a whole number";
    case Parameter::Type::boolean:
      return "true or false";
    case Parameter::Type::text:
      return "a text";
    case Parameter::Type::vector:
      return "a vector";
    case Parameter::Type::numbers:
      return "a number or an array of numbers";
    case Parameter::Type::time_function:
      return "a number, an expression of t or a table";
    case Parameter::Type::named_numbers:
      return "an object of named numbers";
    case Parameter::Type::named_vectors:
      return "an object of named vectors";
    case Parameter::Type::named_parts:
      return "an object of named objects";
  }
  return "a value";
}

std::string quoted(const std::string& text) {
  return fmt::format("\"{}\"", text);
}

template <class T>
std::string array(const T& numbers) {
  return fmt::format("[{}]", fmt::join(numbers.begin(), numbers.end(), ", "));
}

std::string text_of(std::monostate) {
  return "";
}
std::string text_of(double x) {
  return fmt::format("{}", x);
}
std::string text_of(int n) {
  return fmt::format("{}", n);
}
std::string text_of(bool b) {
  return b ? "true" : "false";
}
std::string text_of(const std::string& s) {
  return quoted(s);
}
std::string text_of(const Vec3& x) {
  return array(x);
}
std::string text_of(const std::vector<double>& x) {
  return array(x);
}
std::string text_of(const TimeFunction& f) {
  return f.is_constant() ? text_of(f(0)) : quoted(f.text());
}

std::string text_of(const std::shared_ptr<Component>&) {
  return "{...}";
}

template <class T>
std::string text_of(const Named<T>& named) {
  std::string text;
  for (const auto& [name, value] : named)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", quoted(name), text_of(value));
  return "{" + text + "}";
}

// Breaks a text at blanks into lines of at most 96 characters.
std::string wrapped(std::string_view text, const std::string& indent) {
  std::string lines, line;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > 96) {
      lines += indent + line + "\n";
      line.clear();
    }
    if (!line.empty()) line += ' ';
    line += word;
  }
  return line.empty() ? lines : lines + indent + line + "\n";
}

std::string names_of(const Declaration& declaration) {
  std::vector<std::string> names;
  for (const Parameter& p : declaration.parameters) names.push_back(p.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string describe(const Parameter& parameter, const ParameterValue& fallback, std::size_t name_width) {
  const ParameterTraits& traits = parameter.traits;
  std::string line = fmt::format("  {:<{}}  {}", parameter.name, name_width, expected(parameter));
  if (const std::string value = text(fallback); traits.required)
    line += "; required";
  else
    line += value.empty() ? "; may be left out" : "; default " + value;
  line += "\n";
  const std::string indent(name_width + 4, ' ');
  line += wrapped(traits.doc, indent);
  if (const std::string usual = range(traits.usual_min, false, traits.usual_max); !usual.empty())
    line += indent + "usually " + usual + "\n";
  if (parameter.part) line += wrapped("each with: " + names_of(*parameter.part), indent);
  return line;
}

// The keys that the framework reads in addition to the component's parameters, except "type".
std::string describe_keys(Kind kind) {
  const auto keys = framework_keys(kind).subspan(1);
  if (keys.empty()) return "";
  std::string page = fmt::format("\nKeys of every {}\n", to_string(kind));
  std::size_t width = 0;
  for (const FrameworkKey& key : keys) width = std::max(width, key.name.size());
  for (const FrameworkKey& key : keys) page += aligned(key.name, width, key.doc);
  return page;
}

// A JSON object as an example for a scene: the required parameters, to be filled in.
std::string example(const Declaration& declaration) {
  std::string text = fmt::format("{{\"type\": \"{}\"", declaration.name);
  if (declaration.kind == Kind::joint || declaration.kind == Kind::contact) text += ", \"between\": [...]";
  for (const Parameter& parameter : declaration.parameters)
    if (parameter.traits.required && parameter.name.find('.') == std::string::npos)
      text += fmt::format(", \"{}\": ...", parameter.name);
  return text + "}";
}

}  // namespace

std::string aligned(const std::string& name, std::size_t width, const std::string& text) {
  const std::string indent(width + 4, ' ');
  return fmt::format("  {:<{}}  {}", name, width, wrapped(text, indent).substr(indent.size()));
}

std::string range(double min, bool above_min, double max) {
  if (std::isfinite(min) && std::isfinite(max) && !above_min) return fmt::format("{} to {}", min, max);
  const std::string low = std::isfinite(min) ? fmt::format("{} {}", above_min ? ">" : ">=", min) : "";
  const std::string high = std::isfinite(max) ? fmt::format("<= {}", max) : "";
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

std::string expected(const Parameter& parameter) {
  if (!parameter.choices.empty()) {
    std::string names;
    for (const std::string& choice : parameter.choices) names += (names.empty() ? "" : ", ") + quoted(choice);
    return (parameter.choices.size() > 1 ? "one of " : "") + names;
  }
  const ParameterTraits& traits = parameter.traits;
  std::string text = noun(parameter.type);
  if (const std::string bounds = range(traits.min, traits.above_min, traits.max); !bounds.empty()) text += " " + bounds;
  if (const std::string_view unit = traits.unit; unit != "1" && !unit.empty()) text += fmt::format(" [{}]", unit);
  return text;
}

std::string text(const ParameterValue& value) {
  return std::visit([](const auto& x) { return text_of(x); }, value);
}

ParameterValue default_of(const Entry& entry, const Parameter& parameter) {
  const std::unique_ptr<Component> component = new_component(entry);
  return guard(entry.origin(""), "its parameters", {}, [&] { return parameter.get(*component); });
}

std::string describe(const Entry& entry) {
  const Declaration& declaration = entry.declaration;
  std::string page = fmt::format("{} ({})\n", declaration.name, to_string(declaration.kind));
  page += wrapped(declaration.summary, "  ");
  if (!declaration.source.empty()) page += wrapped("Source: " + declaration.source, "  ");
  page += fmt::format("  Library: {}\n  In a scene: {}\n\n", entry.file, example(declaration));
  page += declaration.parameters.empty() ? "No parameters.\n" : "Parameters\n";
  std::size_t width = 0;
  for (const Parameter& parameter : declaration.parameters) width = std::max(width, parameter.name.size());
  for (const Parameter& parameter : declaration.parameters)
    page += describe(parameter, default_of(entry, parameter), width);
  if (!declaration.markers.empty())
    page += "\nMarkers ('trammel describe markers')\n" + wrapped(declaration.markers, "  ");
  if (!declaration.observables.empty())
    page += "\nObservables ('trammel describe observables')\n" + wrapped(declaration.observables, "  ");
  return page + describe_keys(declaration.kind);
}

const Parameter& Part::declared(std::string_view key) const {
  return std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.declared.name == key; })->declared;
}

std::vector<std::string> Part::names() const {
  std::vector<std::string> all;
  for (const Key& key : keys) all.push_back(key.declared.name);
  return all;
}

std::string describe(const Part& part) {
  std::string page = fmt::format("{} (part of a scene)\n", part.name);
  page += wrapped(part.summary, "  ");
  page += fmt::format("  In a scene: {}\n\nKeys\n", part.example);
  std::size_t width = 0;
  for (const Part::Key& key : part.keys) width = std::max(width, key.declared.name.size());
  for (const Part::Key& key : part.keys) page += describe(key.declared, key.fallback, width);
  for (const std::string& remark : part.remarks) page += "\n" + wrapped(remark, "  ");
  return page;
}

std::string list(const std::vector<const Entry*>& entries) {
  std::size_t width = 0;
  for (const Entry* entry : entries) width = std::max(width, entry->declaration.name.size());
  std::string text;
  const Declaration* previous = nullptr;
  for (const Entry* entry : entries) {
    const Declaration& declaration = entry->declaration;
    if (!previous || previous->kind != declaration.kind)
      text += fmt::format("{}{}\n", previous ? "\n" : "", to_string(declaration.kind));
    text += fmt::format("  {:<{}}  {}\n", declaration.name, width, declaration.summary);
    previous = &declaration;
  }
  return text;
}

}  // namespace trammel::plugin
