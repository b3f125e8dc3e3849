// trammel trade SCENE: speed against accuracy on this scene.
#include <cmath>

#include <fmt/format.h>

#include "arguments.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "next.hpp"
#include "progress.hpp"
#include "results_folder.hpp"
#include "study/cases/workers.hpp"
#include "study/trade/trade.hpp"

namespace trammel::tool {

namespace {

constexpr Option kTradeFolder{"--out", "DIR", "results folder; default out/<scene name>_trade"};
constexpr Option kTradeTarget{"--target", "E",
                              "largest scaled error: the cheapest choice that meets it is found and verified"};
constexpr Option kObserve{"--observe", "NAME", "an observed column that counts (repeatable); default: all"};
constexpr Option kBudget{"--budget", "S", "CPU time to spend [s]; default 40 for each core"};
constexpr Option kGrid{"--grid", "", "run every method at every setting in place of a search"};

Exit run_trade(const Arguments& arguments) {
  study::TradeOptions options;
  options.out = results_folder(arguments, "_trade");
  if (arguments.has(kTradeTarget.name)) options.target = positive(arguments, kTradeTarget);
  if (arguments.has(kJobs.name))
    options.jobs = whole_number(kJobs, arguments.last(kJobs.name), "a whole number from 1");
  constexpr double a_core = 40;  // [s]
  const int cores = options.jobs > 0 ? options.jobs : study::cores_at_hand();
  options.budget = arguments.has(kBudget.name) ? positive(arguments, kBudget) : a_core * cores;
  if (arguments.has(kGrid.name)) options.search = study::TradeOptions::Search::grid;
  options.observe = arguments.all(kObserve.name);
  options.command = arguments.command_line();
  const study::SceneSource source(arguments.operand(), overrides_of(arguments));
  plugin::Registry registry;
  load_plugins(arguments, registry);
  study::require_observed(source, registry, options.observe);
  const simulate::ResultsFolder folder(options.out, simulate::Analysis::trade);
  options.interrupt = &watch_for_interrupts();
  const bool quiet = arguments.has(kJson.name) || arguments.has(kQuiet.name);
  ProgressBar bar(!quiet);
  options.progress = [&bar](double spent, const std::string& what) { bar.draw(spent, what); };
  const study::TradeReport report = study::trade(source, registry, options);
  bar.clear();
  if (arguments.has(kJson.name))
    print_json_text(report.json);
  else if (!quiet)
    print_line(report.summary);
  if (options.interrupt->requested()) return Exit::interrupted;
  print_next(arguments, {"trammel", "report", options.out.native()});
  return report.done && (!options.target || report.choice) ? Exit::done : Exit::failed;
}

}  // namespace

Command trade_command() {
  return {
      "trade",
      "SCENE",
      "Measure speed against accuracy on this scene, and name the cheapest choice that meets a target.",
      {kTradeFolder, kTradeTarget, kObserve, kGrid, kBudget, kJobs, kSet, kPlugin, kAllowScenePlugins, kJson, kQuiet},
      run_trade};
}

}  // namespace trammel::tool
