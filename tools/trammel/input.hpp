// Input and output common to all commands: the scene, plugins, JSON, errors.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "arguments.hpp"
#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::tool {

// The overrides given by --set. Throws UsageError.
std::vector<scene::Override> overrides_of(const Arguments& arguments);

// Loads the operand's scene with the --set overrides, then `more`. Throws scene::SceneError.
scene::Scene load_scene(const Arguments& arguments, std::vector<scene::Override> more = {});

// Adds the libraries and folders given by --plugin; --allow-scene-plugins lets the scene name its own. Throws
// plugin::PluginError.
void load_plugins(const Arguments& arguments, plugin::Registry& registry);

// The option's value, a number > 0. Throws UsageError.
double positive(const Arguments& arguments, const Option& option);
// Reads `text`, an option's value or a part of it, as a whole number from 1 to 999999. Throws UsageError.
int whole_number(const Option& option, const std::string& text, const char* expected);

// With --json standard output carries one object and nothing else. After this call plugins' output goes to standard
// error, and `print_json` and `print_json_text` write to the original standard output.
void keep_output_for_json();
int json_output();  // the descriptor

void print_json(const nlohmann::ordered_json& object);
void print_json_text(const std::string& json);  // takes no memory: results are complete by then
void print_line(const std::string& text);       // takes no memory: results are complete by then

std::vector<std::string> lines(const std::string& text);  // without empty ones

}  // namespace trammel::tool
