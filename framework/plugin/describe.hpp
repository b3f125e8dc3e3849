// Texts about components, from their declarations alone.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plugin/registry.hpp"

namespace trammel::plugin {

// A part of a scene that the program itself reads, such as "simulate", declared as components declare their parameters.
struct Part {
  struct Key {
    Parameter declared;
    ParameterValue fallback;  // what holds if it is left out; none: the doc says
  };
  std::string name, summary, example;
  std::vector<Key> keys;
  std::vector<std::string> remarks;                       // a paragraph each
  const Parameter& declared(std::string_view key) const;  // of one that is there
  std::vector<std::string> names() const;
};

std::string describe(const Entry& entry);  // the manual page of `trammel describe NAME`
std::string describe(const Part& part);
std::string list(const std::vector<const Entry*>& entries);  // `trammel list`: a line each, by kind
// JSON Schema (draft 2020-12) of scenes made of these.
std::string schema(const std::vector<const Entry*>& entries, const std::vector<Part>& parts = {});

// "  name   text", the text wrapped and aligned behind a name of up to `width` characters.
std::string aligned(const std::string& name, std::size_t width, const std::string& text);

// For messages, manual and schema alike.
std::string range(double min, bool above_min, double max);  // "> 0", "0 to 1", "" if anything goes
std::string expected(const Parameter& parameter);           // "a number > 0 [m]", "one of \"none\", \"full\""
std::string text(const ParameterValue& value);              // as it would stand in a scene; "" for none
ParameterValue default_of(const Entry& entry, const Parameter& parameter);

// One component with every parameter at its default. Throws PluginError when its constructor throws.
std::unique_ptr<Component> new_component(const Entry& entry, const std::string& path = "");

}  // namespace trammel::plugin
