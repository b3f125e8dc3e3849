// Creation and modification of Values, for the files of this folder only.
#pragma once

#include "scene/value.hpp"

namespace trammel::scene {

class Builder {
 public:
  using Content = std::variant<Null, bool, double, std::string, Items, Members>;

  static Value make(Content content, const Position& at);
  static Value make(Content content, const Value& in_file, int line, int column);  // in the file of another value
  static Value like(const Value& other, Content content);  // with the position, path and parameters of `other`
  static Items& items(Value& value) { return std::get<Items>(value.content_); }
  static Members& members(Value& value) {
    value.by_name_.reset();
    return std::get<Members>(value.content_);
  }
  static void place(Value& value, const Value& at);  // with the position of another one
  static Value* find(Value& object, std::string_view key);
  // Sets the dotted paths, the scene's parameters and the indices of members in the whole tree. Throws SceneError if
  // the tree exceeds limits::values.
  static void finish(Value& value, const std::string& path, const std::shared_ptr<const Value::Parameters>& parameters);
  static std::uint64_t hash(const Value& value);  // independent of the order of members
  // Number of values in the tree, the root included; long texts and many {...} count as more (limits.hpp).
  static std::size_t size(const Value& value);

 private:
  struct Family {
    std::string path;
    const std::shared_ptr<const Value::Parameters>& parameters;
  };
  static void finish(Value& value, const Family& family, std::string name,
                     std::shared_ptr<const Value::Siblings>& siblings, std::size_t& size);
  static void order_by_name(Value& object);
};

// Parses a text without includes and overrides. Throws SceneError.
Value parse_text(const std::string& text, const std::string& file);

// Merges `over` into `base`: objects member by member; null removes a member; everything else replaces. An object with
// a different "type" replaces the whole object, because the parameters belong to another component.
void merge(Value& base, Value&& over);

// The root merged over all its "include" files, depth first.
Value resolve_includes(Value&& root, const std::string& file);

void apply(const Override& override, Value& root);

// Evaluates the "parameters" block; its expressions may use each other. The result is sorted by name.
std::shared_ptr<const Value::Parameters> evaluate_parameters(const Value& root);

// True if a unit has "for".
bool repeats_units(const Value& root);
// nullptr if there is no parameter of this name.
const Value::Parameter* find_parameter(const Value::Parameters& parameters, std::string_view name);

// Replaces bodies, joints, forces and contacts with "for" by their copies (repeat.cpp). Throws SceneError.
void repeat_units(Value& root, const Value::Parameters& parameters);

// The tree as a JSON text that Scene reads back. Names of other files (tables, plugins) become absolute paths.
std::string written(const Value& root);

// Returns a warning for each parameter that was set but is not used in the scene, directly or through another
// parameter.
std::vector<Problem> set_in_vain(const Value& root, const std::vector<Override>& overrides);

}  // namespace trammel::scene
