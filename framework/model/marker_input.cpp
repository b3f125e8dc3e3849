#include "model/marker_input.hpp"

#include <fmt/format.h>

#include <trammel/needs_orientation.hpp>

#include "model/scene_keys.hpp"

namespace trammel::model {

using scene::Problems;
using scene::Value;

std::optional<MarkerRef> MarkerInput::marker(const Value& value) {
  if (!missing_bodies_) return read_marker(value, model_, problems_);
  Problems ignored;
  return read_marker(value, model_, ignored);
}

void MarkerInput::check_orientation(const Component* component, std::size_t k, MarkerRef marker, const Value& name) {
  const auto* needs = dynamic_cast<const NeedsOrientation*>(component);
  if (!needs || !needs->needs_orientation(int(k)) || has_orientation(model_, marker)) return;
  const char* const instead =
      dynamic_cast<const Constraint*>(component)
          ? "points are tied by spherical, distance or, in the plane, revolute without \"angle\""
          : "on points act spring_damper, hinge_spring and load with a force in world axes";
  problems_.error(name.problem(fmt::format(
      "found \"{}\", a point of bodies.{} with a place but no orientation; expected a marker with an orientation, such "
      "as the ground or one of a rigid_body; {}",
      name.text(), model_.bodies[std::size_t(marker.body)].name, instead)));
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
  for (std::size_t k = 0; k < names->size(); ++k)
    if (const auto found = marker((*names)[k])) {
      check_orientation(joint, k, *found, (*names)[k]);
      markers.push_back(*found);
    }
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
