// Reads objects and marker names of a scene; shared by bodies, joints, forces, contacts and observables.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.hpp"
#include "scene/value.hpp"

namespace trammel::model {

// Reports every member of `object` that is not in `keys`, with the nearest valid key. False: not an object (reported).
bool check_keys(const scene::Value& object, const std::vector<std::string>& keys, scene::Problems& problems);

// A vector of the scene's dimension.
std::optional<Vec3> read_vector(const scene::Value& value, Space space, scene::Problems& problems);

std::optional<MarkerRef> find_marker(const Model& model, std::string_view name);
// What an error says of a name that is no marker, with the valid names and the nearest of them.
std::string no_marker(const Model& model, std::string_view name);
// True if the marker has axes: it is on the ground or on a body, but not a point in natural coordinates.
bool has_orientation(const Model& model, MarkerRef marker);

// A marker's name, or a fixed frame {"point": [x, y], "angle": a}, which is added to the model.
std::optional<MarkerRef> read_marker(const scene::Value& value, Model& model, scene::Problems& problems);

}  // namespace trammel::model
