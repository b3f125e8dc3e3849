// trammel explain SCENE: what was built, what each part costs per step, what was left out.
#include <fmt/format.h>

#include "arguments.hpp"
#include "commands/simulation.hpp"
#include "input.hpp"
#include "last_words.hpp"

namespace trammel::tool {

namespace {

Exit explain(const Arguments& arguments) {
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);
  fmt::print("{}", simulate::explain(scene, registry, &witness()));
  return Exit::done;
}

}  // namespace

Command explain_command() {
  return {"explain",
          "SCENE",
          "Show what is built from a scene, which rows are redundant, what each part costs, what is left out.",
          {kSet, kPlugin, kAllowScenePlugins},
          explain};
}

}  // namespace trammel::tool
