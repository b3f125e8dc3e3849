// trammel list: every component that scenes can name.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "commands/scene_topics.hpp"
#include "compatibility/matrix.hpp"
#include "input.hpp"
#include "next.hpp"
#include "plugin/describe.hpp"
#include "run/setting_parts.hpp"

namespace trammel::tool {

namespace {

constexpr Option kAll{"--all", "", "also the parts of a scene and the pages on its language, for 'trammel describe'"};

constexpr Option kMatrix{"--matrix", "", "what goes with what: integrators, laws, corrections and bodies"};

// Topics of 'trammel describe' other than components.
std::string pages(const std::vector<const plugin::Entry*>& entries) {
  std::string text = "part of a scene\n";
  for (const plugin::Part& part : simulate::setting_parts())
    text += plugin::aligned(part.name, 24, part.summary.substr(0, part.summary.find(". ")));
  text += "\nscene language\n";
  for (const simulate::Topic& topic : simulate::scene_topics(entries))
    text += plugin::aligned(topic.name, 24, topic.summary);
  return text;
}

void warn_of_unusable(const plugin::Registry& registry) {
  for (const plugin::PluginError& error : registry.failures()) fmt::print(stderr, "warning: {}\n", error.what());
}

Exit print_matrix(const Arguments& arguments, plugin::Registry& registry) {
  const compatibility::Matrix matrix = compatibility::matrix(registry);
  if (arguments.has(kJson.name)) {
    nlohmann::ordered_json all = {{"status", "done"}};
    all.update(compatibility::to_json(matrix));
    print_json(all);
    return Exit::done;
  }
  fmt::print("{}\n", compatibility::text(matrix));
  print_next(arguments, {"trammel", "describe", "NAME"}, {kPlugin});
  warn_of_unusable(registry);
  return Exit::done;
}

Exit list(const Arguments& arguments) {
  plugin::Registry registry;
  load_plugins(arguments, registry);
  if (arguments.has(kMatrix.name)) return print_matrix(arguments, registry);
  const auto entries = registry.all();
  if (arguments.has("--json")) {
    nlohmann::ordered_json components = nlohmann::ordered_json::array(), unusable = nlohmann::ordered_json::array();
    for (const plugin::Entry* entry : entries) {
      const Declaration& declaration = entry->declaration;
      components.push_back({{"kind", to_string(declaration.kind)},
                            {"name", declaration.name},
                            {"summary", declaration.summary},
                            {"source", declaration.source},
                            {"file", entry->file}});
    }
    for (const plugin::PluginError& error : registry.failures())
      unusable.push_back({{"file", error.origin().file}, {"message", error.what()}});
    print_json({{"status", "done"}, {"components", components}, {"unusable", unusable}});
    return Exit::done;
  }
  fmt::print("{}", plugin::list(entries));
  if (arguments.has(kAll.name)) fmt::print("\n{}", pages(entries));
  fmt::print("\n");
  print_next(arguments, {"trammel", "describe", "NAME"}, {kPlugin});
  warn_of_unusable(registry);
  return Exit::done;
}

}  // namespace

Command list_command() {
  return {"list",
          "",
          "List all components: integrators, bodies, joints, forces, contacts, friction, corrections.",
          {kAll, kMatrix, kPlugin, kJson},
          list};
}

}  // namespace trammel::tool
