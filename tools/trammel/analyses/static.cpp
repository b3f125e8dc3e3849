// trammel static SCENE: equilibria under growing loads, and their results folder.
#include <fmt/format.h>

#include "arguments.hpp"
#include "beside_results.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "last_words.hpp"
#include "next.hpp"
#include "progress.hpp"
#include "results_folder.hpp"
#include "statics/static_run.hpp"

namespace trammel::tool {

namespace {

constexpr Option kStaticFolder{"--out", "DIR", "results folder; default out/<scene name>_static"};

Exit run_static(const Arguments& arguments) {
  const bool json = arguments.has("--json"), quiet = arguments.has("--quiet");
  const BesideResults beside(arguments);
  simulate::RunOptions options;
  options.out = results_folder(arguments, "_static");
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);
  const simulate::ResultsFolder folder(options.out, simulate::Analysis::statics);
  options.command = arguments.command_line();
  options.interrupt = &watch_for_interrupts();
  options.witness = &witness();
  simulate::RunReport report;
  {
    ProgressBar bar(!json && !quiet);
    if (bar.wanted()) options.progress = [&bar](const simulate::Progress& progress) { bar.draw(progress); };
    report = simulate::run_static(scene, registry, options);
  }
  if (json) print_json_text(report.result_json);
  if (!json && !quiet) print_line(report.summary);
  beside.write(options.out, json || quiet);
  if (report.status == simulate::Status::done) {
    print_next(arguments, {"trammel", "report", options.out.native()});
    return Exit::done;
  }
  fmt::print(stderr, "trammel: {}\nResults up to there are in {}\n", report.reason, options.out.string());
  return report.status == simulate::Status::interrupted ? Exit::interrupted : Exit::failed;
}

}  // namespace

Command static_command() {
  return {"static",
          "SCENE",
          "Find equilibria under growing loads: t is the load.",
          {kStaticFolder, kSet, kPlugin, kAllowScenePlugins, kReport, kFormat, kJson, kQuiet},
          run_static};
}

}  // namespace trammel::tool
