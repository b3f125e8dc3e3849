// trammel validate SCENE: read everything and build the model without running.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "commands/simulation.hpp"
#include "input.hpp"
#include "last_words.hpp"
#include "next.hpp"

namespace trammel::tool {

namespace {

Exit validate(const Arguments& arguments) {
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);
  const std::string warnings = simulate::validate(scene, registry, &witness());
  if (arguments.has("--json")) {
    print_json({{"status", "done"}, {"scene", arguments.operand()}, {"warnings", lines(warnings)}});
  } else {
    for (const std::string& warning : lines(warnings)) fmt::print(stderr, "warning: {}\n", warning);
    fmt::print("{} is valid\n", arguments.operand());
    print_next(arguments, {"trammel", "run", arguments.operand()}, {kSet, kPlugin, kAllowScenePlugins});
  }
  return Exit::done;
}

}  // namespace

Command validate_command() {
  return {"validate",
          "SCENE",
          "Check a scene without running it; every problem is reported.",
          {kSet, kPlugin, kAllowScenePlugins, kJson},
          validate};
}

}  // namespace trammel::tool
