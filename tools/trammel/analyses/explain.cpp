// trammel explain SCENE: what was built, what each part costs per step, what was left out.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "commands/simulation.hpp"
#include "input.hpp"
#include "last_words.hpp"
#include "next.hpp"
#include "report/page.hpp"
#include "study/evidence/ablation.hpp"

namespace trammel::tool {

namespace {

constexpr Option kAblate{"--ablate", "",
                         "leave out each optional part in turn, and find the smallest scene that keeps the target"};
constexpr Option kExplainTarget{"--target", "X",
                                "of --ablate: the change allowed, in parts of what the observables change; 1e-3"};

Exit ablate(const Arguments& arguments, plugin::Registry& registry) {
  const double target = arguments.has(kExplainTarget.name) ? positive(arguments, kExplainTarget) : 1e-3;
  const study::SceneSource source(arguments.operand(), overrides_of(arguments));
  const report::Page page = study::page_of(study::ablate(source, registry, target), arguments.operand());
  if (arguments.has(kJson.name))
    print_json({{"status", "done"}, {"page", report::to_json(page)}});
  else
    fmt::print("{}", report::text(page));
  return Exit::done;
}

void print_as_json(const std::string& scene, const std::vector<simulate::ExplainedPart>& parts) {
  nlohmann::ordered_json sections = nlohmann::ordered_json::array();
  for (const simulate::ExplainedPart& part : parts) sections.push_back({{"title", part.title}, {"lines", part.lines}});
  print_json({{"status", "done"}, {"scene", scene}, {"sections", sections}});
}

Exit explain(const Arguments& arguments) {
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);
  if (arguments.has(kAblate.name)) return ablate(arguments, registry);
  const auto parts = simulate::explain(scene, registry, &witness());
  if (arguments.has(kJson.name))
    print_as_json(arguments.operand(), parts);
  else
    fmt::print("{}\n", simulate::text_of(parts));
  print_next(arguments, {"trammel", "run", arguments.operand()}, {kSet, kPlugin, kAllowScenePlugins});
  return Exit::done;
}

}  // namespace

Command explain_command() {
  return {"explain",
          "SCENE",
          "Show what is built from a scene, which rows are redundant, what each part costs, what is left out.",
          {kSet, kPlugin, kAllowScenePlugins, kAblate, kExplainTarget, kJson},
          explain};
}

}  // namespace trammel::tool
