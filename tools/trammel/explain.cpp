// trammel explain SCENE: what was built, what each part costs per step, what was left out.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "commands/simulation.hpp"
#include "input.hpp"
#include "last_words.hpp"

namespace trammel::tool {

namespace {

void print_as_json(const std::string& scene, const std::vector<simulate::ExplainedPart>& parts) {
  nlohmann::ordered_json sections = nlohmann::ordered_json::array();
  for (const simulate::ExplainedPart& part : parts) sections.push_back({{"title", part.title}, {"lines", part.lines}});
  print_json({{"status", "done"}, {"scene", scene}, {"sections", sections}});
}

Exit explain(const Arguments& arguments) {
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);
  const auto parts = simulate::explain(scene, registry, &witness());
  if (arguments.has(kJson.name))
    print_as_json(arguments.operand(), parts);
  else
    fmt::print("{}", simulate::text_of(parts));
  return Exit::done;
}

}  // namespace

Command explain_command() {
  return {"explain",
          "SCENE",
          "Show what is built from a scene, which rows are redundant, what each part costs, what is left out.",
          {kSet, kPlugin, kAllowScenePlugins, kJson},
          explain};
}

}  // namespace trammel::tool
