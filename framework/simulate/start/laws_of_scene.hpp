// The laws of time of a scene's components, wherever their declarations have one: also of parts, of a contact's
// friction and of the joint that it reaches.
#pragma once

#include <functional>
#include <vector>

#include "plugin/parameters.hpp"
#include "scene/laws/resolution.hpp"
#include "scene/value.hpp"

namespace trammel::simulate {

// Calls each(value, law, parameter) for each law that is not constant.
using EachLaw = std::function<void(const scene::Value&, const TimeFunction&, const Parameter&)>;
void for_each_law(const scene::Value& root, plugin::Registry& registry, const EachLaw& each);

// All of them, equal ones once.
std::vector<scene::LawOfTime> laws_of_scene(const scene::Value& root, plugin::Registry& registry);

}  // namespace trammel::simulate
