// A contact of a scene:
//
//     ["ball.com", {"plane": {"point": [0, 0], "normal": [0, 1], "on": "table.top"}}]     "radius": disk, sphere
//     ["ball.com", {"surface": "plate"}]    [{"surface": "plate"}, {"plane": ...}]
//     [{"surface": "upper"}, {"surface": "lower"}]
//     [A, B] with "reaches": {"type": "distance", "length": 1}, "from": "above": a joint's row from one side
//
// with its contact law and, under "friction", a friction law.
#pragma once

#include <string>

#include "model/marker_input.hpp"
#include "plugin/registry.hpp"

namespace trammel::model {

// Adds the contact to the model, unless there are problems, which are all reported.
void add_contact(const std::string& name, const scene::Value& value, MarkerInput& markers, Model& model,
                 plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::model
