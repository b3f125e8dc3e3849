// trammel modes SCENE: frequencies, damping and shapes of small motions about a state, and their results folder.
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "arguments.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "last_words.hpp"
#include "modes/modal_analysis.hpp"
#include "next.hpp"
#include "results_folder.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

constexpr Option kModesFolder{"--out", "DIR", "results folder; default out/<scene name>_modes"};
constexpr Option kAt{"--at", "TIME",
                     "the state after a run to that time [s], or under the loads of it in a scene of statics"};
constexpr Option kFrom{"--from", "DIR", "the state of the checkpoint in a results folder"};
constexpr Option kSteady{"--steady", "",
                         "the steady motion near that state, seen from the world or from a frame that turns with it"};
constexpr Option kCount{"--count", "N", "so many of the lowest modes; default 10"};
constexpr Option kMatrices{"--matrices", "FILE",
                           "write M, D, K, G and the state-space matrix to FILE.npz and FILE_*.mtx, with the names of "
                           "their rows"};

double number(const Arguments& arguments, const Option& option, const char* expected) {
  const std::string& text = arguments.last(option.name);
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x))
    throw UsageError(fmt::format("{} {}: expected {}", option.name, text, expected));
  return x;
}

simulate::ModesOptions read(const Arguments& arguments) {
  simulate::ModesOptions options;
  options.out = results_folder(arguments, "_modes");
  if (arguments.has("--count")) {
    const char* expected = "a whole number of modes from 1 to 100000";
    const double count = number(arguments, kCount, expected);
    if (!(count >= 1 && count <= 1e5 && count == std::floor(count)))
      throw UsageError(fmt::format("--count {}: expected {}", arguments.last("--count"), expected));
    options.count = int(count);
  }
  if (arguments.has("--at")) options.at = number(arguments, kAt, "a time in s");
  if (arguments.has("--from")) {
    if (options.at) throw UsageError("--at and --from exclude each other: a checkpoint has its own time");
    const fs::path folder = arguments.last("--from");
    std::error_code error;
    if (!fs::exists(folder / "checkpoint.cbor", error))
      throw UsageError(fmt::format("--from {0}: there is no {0}/checkpoint.cbor", folder.string()));
    options.from = folder;
  }
  options.steady = arguments.has("--steady");
  if (arguments.has(kMatrices.name)) options.matrices = arguments.last(kMatrices.name);
  return options;
}

Exit run_modes(const Arguments& arguments) {
  const bool json = arguments.has("--json"), quiet = arguments.has("--quiet");
  simulate::ModesOptions options = read(arguments);
  std::vector<scene::Override> more;
  if (options.at) more.push_back({"simulate.until", fmt::format("{:.17g}", *options.at)});
  const scene::Scene scene = load_scene(arguments, std::move(more));
  plugin::Registry registry;
  load_plugins(arguments, registry);
  const simulate::ResultsFolder folder(options.out, simulate::Analysis::modes);
  options.command = arguments.command_line();
  options.interrupt = &watch_for_interrupts();
  options.witness = &witness();
  const simulate::RunReport report = simulate::analyse_modes(scene, registry, options);
  if (report.status != simulate::Status::done) {
    if (json) print_json_text(report.result_json);
    fmt::print(stderr, "trammel: on the way to t = {:.9g}: {}\n", *options.at, report.reason);
    return report.status == simulate::Status::interrupted ? Exit::interrupted : Exit::failed;
  }
  if (json) print_json_text(report.result_json);
  if (!json && !quiet) print_line(report.summary);
  print_next(arguments, {"trammel", "report", options.out.native()});
  return Exit::done;
}

}  // namespace

Command modes_command() {
  return {"modes",
          "SCENE",
          "Find frequencies, damping and shapes of small motions about a state.",
          {kModesFolder, kAt, kFrom, kSteady, kCount, kMatrices, kSet, kPlugin, kAllowScenePlugins, kJson, kQuiet},
          run_modes};
}

}  // namespace trammel::tool
