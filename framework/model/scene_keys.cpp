#include "model/scene_keys.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <trammel/linear_rows.hpp>

#include "scene/suggestion.hpp"

namespace trammel::model {
namespace {

using scene::Problems;
using scene::Value;

}  // namespace

bool check_keys(const Value& object, const std::vector<std::string>& keys, Problems& problems) {
  if (object.type() != Value::Type::object) {
    problems.error(
        object.problem(fmt::format("found {}, expected an object with {}", object.type_name(), fmt::join(keys, ", "))));
    return false;
  }
  for (const auto& [key, value] : object.members())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      problems.error(value.problem(fmt::format("unknown key \"{}\"{}", key, scene::did_you_mean(key, keys))));
  return true;
}

std::optional<Vec3> read_vector(const Value& value, Space space, Problems& problems) {
  const auto numbers = value.read_numbers(problems);
  if (!numbers) return {};
  if (int(numbers->size()) != dimension(space)) {
    problems.error(value.problem(fmt::format("found {} numbers, expected {}: the scene is {}", numbers->size(),
                                             dimension(space), space == Space::planar ? "planar" : "spatial")));
    return {};
  }
  return Vec3(Eigen::Map<const Vec>(numbers->data(), Eigen::Index(numbers->size())));
}

namespace {

// Every marker of the model: "ground", "beam.root", "beam.tip".
std::vector<std::string> marker_names(const Model& model) {
  std::vector<std::string> names = {"ground"};
  for (const BodyEntry& entry : model.bodies)
    for (const std::string& marker : entry.body->markers()) names.push_back(entry.name + "." + marker);
  return names;
}

}  // namespace

std::string no_marker(const Model& model, std::string_view name) {
  const std::string_view body = name.substr(0, name.find('.'));
  const bool no_body = body.size() < name.size() && !model.body_named.contains(body);
  return fmt::format("no marker \"{}\"{}{}", name, no_body ? fmt::format(", since no body \"{}\"", body) : "",
                     scene::did_you_mean(name, marker_names(model)));
}

std::optional<MarkerRef> find_marker(const Model& model, std::string_view name) {
  if (name == "ground") return MarkerRef{};
  const auto dot = name.find('.');  // names of bodies have no dot
  if (dot == name.npos) return {};
  const auto body = model.body_named.find(name.substr(0, dot));
  if (body == model.body_named.end()) return {};
  const auto markers = model.bodies[std::size_t(body->second)].body->markers();
  const auto found = std::find(markers.begin(), markers.end(), name.substr(dot + 1));
  if (found == markers.end()) return {};
  return MarkerRef{body->second, int(found - markers.begin())};
}

bool has_orientation(const Model& model, MarkerRef marker) {
  return marker.body < 0 || !dynamic_cast<const LinearMarkers*>(model.bodies[std::size_t(marker.body)].body.get());
}

namespace {

// {"point": [x, y], "angle": a}, in space with "axis"; adds the frame to the model.
std::optional<MarkerRef> read_fixed_frame(const Value& value, Model& model, Problems& problems) {
  if (!value.find("point")) {
    problems.error(
        value.problem("found an object, expected a marker's name or a fixed frame {\"point\": ..., \"angle\": ...}"));
    return {};
  }
  check_keys(value, {"point", "angle", "axis"}, problems);
  GroundFrame frame;
  const auto point = read_vector(*value.find("point"), model.world.space, problems);
  if (const Value* angle = value.find("angle")) frame.angle = angle->read_number(problems).value_or(0);
  if (const Value* axis = value.find("axis")) {
    const auto direction = read_vector(*axis, model.world.space, problems);
    if (model.world.space == Space::planar)
      problems.error(axis->problem("a planar scene's frame turns about the plane's normal; remove the axis"));
    else if (direction && !(direction->stableNorm() > 0))
      problems.error(axis->problem("the axis has length 0; expected a direction, e.g. [0, 0, 1]"));
    else if (direction)
      frame.axis = direction->stableNormalized();
  }
  if (!point) return {};
  frame.x = *point;
  model.ground_frames.push_back(frame);
  return MarkerRef{-1, int(model.ground_frames.size()) - 1};
}

}  // namespace

std::optional<MarkerRef> read_marker(const Value& value, Model& model, Problems& problems) {
  if (value.type() == Value::Type::object) return read_fixed_frame(value, model, problems);
  const auto name = value.read_text(problems);
  if (!name) return {};
  if (const auto marker = find_marker(model, *name)) return marker;
  problems.error(value.problem(no_marker(model, *name)));
  return {};
}

}  // namespace trammel::model
