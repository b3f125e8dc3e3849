// trammel describe NAME: the manual page of a component, of a part of a scene, or of the scene language.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arguments.hpp"
#include "commands/scene_topics.hpp"
#include "input.hpp"
#include "plugin/describe.hpp"
#include "run/setting_parts.hpp"

namespace trammel::tool {

namespace {

Exit describe(const Arguments& arguments) {
  std::vector<std::string> names;
  for (const plugin::Part& part : simulate::setting_parts()) {
    names.push_back(part.name);
    if (part.name != arguments.operand()) continue;
    fmt::print("{}", plugin::describe(part));
    return Exit::done;
  }
  plugin::Registry registry;
  load_plugins(arguments, registry);
  for (const simulate::Topic& topic : simulate::scene_topics(registry.all())) {
    names.push_back(topic.name);
    if (topic.name != arguments.operand()) continue;
    fmt::print("{}", topic.page);
    return Exit::done;
  }
  try {
    const char* separator = "";
    for (const plugin::Entry* entry : registry.find_any(arguments.operand())) {
      fmt::print("{}{}", separator, plugin::describe(*entry));
      separator = "\n";
    }
  } catch (const plugin::UnknownComponent& unknown) {
    throw UsageError(fmt::format("{}. Of the scene language: {}", unknown.what(), fmt::join(names, ", ")));
  }
  return Exit::done;
}

}  // namespace

Command describe_command() {
  return {"describe",
          "NAME",
          "Show the manual page of a component, of a part of a scene (simulate, step), or of the language (scene, "
          "markers).",
          {kPlugin},
          describe};
}

}  // namespace trammel::tool
