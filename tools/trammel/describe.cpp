// trammel describe NAME: the manual page of a component, of a part of a scene, or of the scene language.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "commands/scene_topics.hpp"
#include "input.hpp"
#include "next.hpp"
#include "plugin/describe.hpp"
#include "plugin/describe_json.hpp"
#include "run/setting_parts.hpp"
#include "scene/suggestion.hpp"

namespace trammel::tool {

namespace {

// The page on the scene language with the nearest name, unless a component's is nearer.
std::string nearest_page(const std::string& name, const std::vector<std::string>& pages, plugin::Registry& registry) {
  std::vector<std::string> all = pages;
  for (const plugin::Entry* entry : registry.all()) all.push_back(entry->declaration.name);
  const std::string nearest = scene::nearest(name, all);
  return std::find(pages.begin(), pages.end(), nearest) == pages.end() ? std::string() : nearest;
}

// Prints pages as text, or collects them for one JSON object.
class Pages {
 public:
  explicit Pages(bool as_json) : as_json_(as_json) {}
  template <class Described>
  void add(const Described& described) {
    if (as_json_)
      pages_.push_back(plugin::describe_json(described));
    else
      fmt::print("{}{}", std::exchange(separator_, "\n"), plugin::describe(described));
  }
  void add(const simulate::Topic& topic) {
    if (as_json_)
      pages_.push_back(
          {{"kind", "scene language"}, {"name", topic.name}, {"summary", topic.summary}, {"text", topic.page}});
    else
      fmt::print("{}", topic.page);
  }
  Exit end() const {
    if (as_json_) print_json({{"status", "done"}, {"pages", pages_}});
    return Exit::done;
  }

 private:
  bool as_json_;
  const char* separator_ = "";
  nlohmann::ordered_json pages_ = nlohmann::ordered_json::array();
};

// `command`: the next command for a scene that names the described component.
Exit end(const Arguments& arguments, const Pages& pages, const char* command = "validate") {
  const Exit exit = pages.end();
  fmt::print("{}", arguments.has(kJson.name) ? "" : "\n");
  print_next(arguments, {"trammel", command, "SCENE"}, {kPlugin});
  return exit;
}

Exit describe(const Arguments& arguments) {
  Pages pages(arguments.has(kJson.name));
  std::vector<std::string> names;
  for (const plugin::Part& part : simulate::setting_parts()) {
    names.push_back(part.name);
    if (part.name != arguments.operand()) continue;
    pages.add(part);
    return end(arguments, pages);
  }
  plugin::Registry registry;
  load_plugins(arguments, registry);
  for (const simulate::Topic& topic : simulate::scene_topics(registry.all())) {
    names.push_back(topic.name);
    if (topic.name != arguments.operand()) continue;
    pages.add(topic);
    return end(arguments, pages);
  }
  const char* command = "validate";
  try {
    for (const plugin::Entry* entry : registry.find_any(arguments.operand())) {
      pages.add(*entry);
      if (entry->declaration.kind == Kind::integrator) command = "trade";
    }
  } catch (const plugin::UnknownComponent& unknown) {
    if (const std::string page = nearest_page(arguments.operand(), names, registry); !page.empty())
      throw UsageError(fmt::format("no component \"{}\". Did you mean \"{}\", a page on the scene language?",
                                   arguments.operand(), page));
    throw UsageError(fmt::format("{}. Of the scene language: {}", unknown.what(), fmt::join(names, ", ")));
  }
  return end(arguments, pages, command);
}

}  // namespace

Command describe_command() {
  return {"describe",
          "NAME",
          "Show the manual page of a component, of a part of a scene (simulate, step), or of the language (scene, "
          "markers).",
          {kPlugin, kJson},
          describe};
}

}  // namespace trammel::tool
