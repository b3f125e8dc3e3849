// How the files of this folder make and change Values; nobody else does.
#pragma once

#include "scene/value.hpp"

namespace trammel::scene {

class Builder {
 public:
  using Content = std::variant<Null, bool, double, std::string, Items, Members>;

  static Value make(Content content, Position at);
  static Value like(const Value& other, Content content);  // at its place, with its path and parameters
  static Items& items(Value& value) { return std::get<Items>(value.content_); }
  static Members& members(Value& value) {
    value.by_name_.clear();
    return std::get<Members>(value.content_);
  }
  static void place(Value& value, Position at) { value.position_ = std::move(at); }
  static Value* find(Value& object, std::string_view key);
  // Dotted paths, the scene's parameters and ways to find members, for the whole tree. Throws SceneError where it grows beyond
  // limits::values.
  static void finish(Value& value, const std::string& path, const std::shared_ptr<const Value::Parameters>& parameters);
  static std::uint64_t hash(const Value& value);  // independent of the order of members
  // How many values it has, itself among them; long texts and many {...} count as more (limits.hpp).
  static std::size_t size(const Value& value);

 private:
  static void finish(Value& value, const std::string& path, const std::shared_ptr<const Value::Parameters>& parameters,
                     std::size_t& size);
  static void order_by_name(Value& object);
};

// A text as it stands. Throws SceneError.
Value parse_text(const std::string& text, const std::string& file);

// `over` onto `base`: objects merge member by member, null removes one, all else replaces. An object with another "type" replaces the
// whole one: parameters of one component mean nothing to another.
void merge(Value& base, Value&& over);

// The root with all its "include" files merged under it, depth first.
Value resolve_includes(Value&& root, const std::string& file);

void apply(const Override& override, Value& root);

// The "parameters" block, evaluated, in the order of their names; expressions in it may use one another.
std::shared_ptr<const Value::Parameters> evaluate_parameters(const Value& root);

// Whether a unit has "for".
bool repeats_units(const Value& root);
// nullptr: there is none of this name.
const Value::Parameter* find_parameter(const Value::Parameters& parameters, std::string_view name);

// Puts copies in place of bodies, joints, forces and contacts with "for" (repeat.cpp). Throws SceneError.
void repeat_units(Value& root, const Value::Parameters& parameters);

// The tree as a JSON text that Scene reads back. Files beside the scene that it names (tables, plugins) become absolute paths.
std::string written(const Value& root);

// A warning for each parameter that was set and that nothing in the scene uses, directly or through another parameter.
std::vector<Problem> set_in_vain(const Value& root, const std::vector<Override>& overrides);

}  // namespace trammel::scene
