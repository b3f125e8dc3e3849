// Texts about components, derived from their declarations.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plugin/registry.hpp"

namespace trammel::plugin {

// A part of a scene that the program itself reads, such as "simulate". It is declared like a component's parameters.
struct Part {
  struct Key {
    Parameter declared;
    ParameterValue fallback;  // the default; none: the doc describes it
  };
  std::string name, summary, example;
  std::vector<Key> keys;
  std::vector<std::string> remarks;                       // one paragraph each
  const Parameter& declared(std::string_view key) const;  // the key must exist
  std::vector<std::string> names() const;
};

std::string describe(const Entry& entry);  // the manual page of `trammel describe NAME`
std::string describe(const Part& part);
std::string list(const std::vector<const Entry*>& entries);  // `trammel list`: one line each, by kind
// JSON Schema (draft 2020-12) of scenes with these components.
std::string schema(const std::vector<const Entry*>& entries, const std::vector<Part>& parts = {});

// "  name   text": the text is wrapped and aligned after a name of up to `width` characters.
std::string aligned(const std::string& name, std::size_t width, const std::string& text);

// Used by messages, manual and schema.
std::string range(double min, bool above_min, double max);  // "> 0", "0 to 1", "" without limits
std::string expected(const Parameter& parameter);           // "a number > 0 [m]", "one of \"none\", \"full\""
std::string text(const ParameterValue& value);              // as written in a scene; "" for none
ParameterValue default_of(const Entry& entry, const Parameter& parameter);

// One component with every parameter at its default. Throws PluginError if its constructor throws.
std::unique_ptr<Component> new_component(const Entry& entry, const std::string& path = "");

}  // namespace trammel::plugin
