#include "input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace trammel::tool {

std::vector<scene::Override> overrides_of(const Arguments& arguments) {
  std::vector<scene::Override> overrides;
  for (const std::string& text : arguments.all("--set")) {
    const auto equals = text.find('=');
    if (equals == text.npos || equals == 0)
      throw UsageError(fmt::format("--set {}: expected PATH=VALUE, e.g. --set contacts.tip.restitution=0.3", text));
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

namespace {

// Reports a file of another kind as such, instead of an error for each of its keys.
void require_scene(const scene::Value& root) {
  if (root.find("trammel")) return;
  if (const scene::Value* study = root.find("study"))
    throw scene::SceneError({study->problem("this file is a study, and no scene: trammel study takes it")});
  if (const scene::Value* result = root.find("trammel_result"))
    throw scene::SceneError(
        {result->problem("this file is the result of a run, and no scene; scene.resolved.json "
                         "beside it is the scene")});
}

}  // namespace

scene::Scene load_scene(const Arguments& arguments, std::vector<scene::Override> more) {
  std::vector<scene::Override> overrides = overrides_of(arguments);
  overrides.insert(overrides.end(), more.begin(), more.end());
  scene::Scene scene = scene::Scene::load(arguments.operand(), overrides);
  require_scene(scene.root());
  return scene;
}

void load_plugins(const Arguments& arguments, plugin::Registry& registry) {
  if (arguments.has(kAllowScenePlugins.name)) registry.allow_scene_plugins();
  for (const std::string& library : arguments.all("--plugin")) registry.search(library);
}

double positive(const Arguments& arguments, const Option& option) {
  const std::string& text = arguments.last(option.name);
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x) || x <= 0)
    throw UsageError(fmt::format("{} {}: expected a number > 0, e.g. 1e-4", option.name, text));
  return x;
}

int whole_number(const Option& option, const std::string& text, const char* expected) {
  if (text.empty() || text.size() > 6 || text.find_first_not_of("0123456789") != text.npos || std::stoi(text) == 0)
    throw UsageError(fmt::format("{} {}: expected {}", option.name, text, expected));
  return std::stoi(text);
}

namespace {

int kept_output = STDOUT_FILENO;

}  // namespace

int json_output() {
  return kept_output;
}

void keep_output_for_json() {
  constexpr int high = 100;  // a library that prints is unlikely to use it
  const int kept = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, high);
  if (kept >= 0 && ::dup2(STDERR_FILENO, STDOUT_FILENO) >= 0) kept_output = kept;
}

void print_json(const nlohmann::ordered_json& object) {
  // File names need not be UTF-8; invalid bytes are replaced, so that the output stays JSON.
  print_json_text(object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_json_text(const std::string& json) {
  std::fflush(stdout);
  if (kept_output != STDOUT_FILENO) ::dup2(kept_output, STDOUT_FILENO);
  print_line(json);
  std::fflush(stdout);
  if (kept_output != STDOUT_FILENO) ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

void print_line(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fputc('\n', stdout);
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) all.push_back(line);
  return all;
}

}  // namespace trammel::tool
