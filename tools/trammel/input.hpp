// Input and output common to all commands: the scene, plugins, JSON, errors.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "arguments.hpp"
#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::tool {

// Those of --set. Throws UsageError.
std::vector<scene::Override> overrides_of(const Arguments& arguments);

// The operand with its --set overrides, then `more`. Throws scene::SceneError.
scene::Scene load_scene(const Arguments& arguments, std::vector<scene::Override> more = {});

// Adds the libraries and folders given by --plugin; --allow-scene-plugins lets the scene name its own. Throws
// plugin::PluginError.
void load_plugins(const Arguments& arguments, plugin::Registry& registry);

// The option's value, a number > 0. Throws UsageError.
double positive(const Arguments& arguments, const Option& option);

void print_json(const nlohmann::ordered_json& object);
void print_line(const std::string& text);  // takes no memory: results are complete by then

std::vector<std::string> lines(const std::string& text);  // without empty ones

}  // namespace trammel::tool
