#include "model/marker_input.hpp"

#include <fmt/format.h>

#include "model/scene_keys.hpp"

namespace trammel::model {

using scene::Problems;
using scene::Value;

std::optional<MarkerRef> MarkerInput::marker(const Value& value) {
  if (!missing_bodies_) return read_marker(value, model_, problems_);
  Problems ignored;
  return read_marker(value, model_, ignored);
}

const scene::Items* MarkerInput::between(const Value& object, std::size_t count) {
  static const char* const numbers[] = {"two", "three", "four"};
  static const char* const lists[] = {"[A, B]", "[A, B, C]", "[A, B, C, D]"};
  const Value* markers = object.find("between");
  if (!markers) {
    problems_.error(object.problem(fmt::format("\"between\": {} is missing: the {} markers it acts between",
                                               lists[count - 2], numbers[count - 2])));
    return nullptr;
  }
  if (markers->type() != Value::Type::array || markers->items().size() != count) {
    problems_.error(
        markers->problem(fmt::format("expected {} entries: \"between\": {}", numbers[count - 2], lists[count - 2])));
    return nullptr;
  }
  return &markers->items();
}

std::vector<MarkerRef> MarkerInput::markers_of(const Value& object, const Constraint* joint) {
  const scene::Items* names = between(object, joint ? std::size_t(joint->marker_count()) : 2);
  if (!names) return {};
  std::vector<MarkerRef> markers;
  for (const Value& name : *names)
    if (const auto found = marker(name)) markers.push_back(*found);
  if (markers.size() != names->size()) return {};
  for (const MarkerRef& other : markers)
    if (other.body != markers[0].body) return markers;
  const char* const all = markers.size() == 2 ? "both" : "all";
  const int body = markers[0].body;
  problems_.error(object.problem(
      body < 0 ? fmt::format("{} markers are fixed in the world; a joint ties a body to something else", all)
               : fmt::format("{} markers belong to bodies.{}; a joint ties a body to something else", all,
                             model_.bodies[std::size_t(body)].name)));
  return {};
}

}  // namespace trammel::model
