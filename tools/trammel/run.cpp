// trammel run SCENE: simulate and write the results folder.
#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "analyses.hpp"
#include "arguments.hpp"
#include "beside_results.hpp"
#include "commands/simulation.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "last_words.hpp"
#include "next.hpp"
#include "progress.hpp"
#include "results_folder.hpp"
#include "scene/suggestion.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

constexpr Option kVerify{"--verify", "",
                         "run again with finer steps and by another method: an error for every observable"};
constexpr Option kResume{"--resume", "DIR", "continue the interrupted run whose results are in DIR"};

struct Output {
  bool json, quiet;
  bool texts() const { return !json && !quiet; }
};

fs::path folder_of_run(const Arguments& arguments) {
  if (!arguments.has("--resume")) return results_folder(arguments);
  if (arguments.has("--out"))
    throw UsageError("--out and --resume exclude each other: a resumed run goes on in its own folder");
  const fs::path folder = arguments.last("--resume");
  std::error_code error;
  if (!fs::exists(folder / simulate::newest_checkpoint, error) &&
      !fs::exists(folder / simulate::checkpoint_before, error))
    throw UsageError(fmt::format("--resume {0}: there is no {0}/checkpoint.cbor to continue from", folder.string()));
  return folder;
}

// The command that resumes this run, with all arguments that define the scene.
std::string continuation(const Arguments& arguments, const fs::path& folder) {
  std::string command = shell_quoted(arguments.program()) + " run";
  const auto add = [&command](const std::string& word) { command += " " + shell_quoted(word); };
  for (const char* option : {"--plugin", "--set"})
    for (const std::string& value : arguments.all(option)) add(option), add(value);
  if (arguments.has(kAllowScenePlugins.name)) add(std::string(kAllowScenePlugins.name));
  add("--resume"), add(folder.string());
  if (arguments.operand().starts_with("-")) add("--");
  add(arguments.operand());
  return command;
}

// Simulates, with warnings and progress on standard error.
simulate::RunReport simulate_visibly(const scene::Scene& scene, plugin::Registry& registry,
                                     simulate::RunOptions options, const Output& output) {
  ProgressBar bar(output.texts());
  if (!output.quiet)
    options.warn = [&bar](const std::string& warning) {
      bar.clear();
      fmt::print(stderr, "trammel: warning: {}\n", warning);
    };
  if (bar.wanted()) options.progress = [&bar](const simulate::Progress& progress) { bar.draw(progress); };
  return simulate::run(scene, registry, options);
}

void explain_failure(const Arguments& arguments, plugin::Registry& registry, simulate::RunReport& report,
                     const fs::path& folder, bool quiet) {
  fmt::print(stderr, "trammel: {}\nResults up to there are in {}\n", report.reason, folder.string());
  if (!report.no_motion || quiet) return;
  try {
    analyses().find_remedy(arguments, registry, report, folder);
  } catch (const std::exception& e) {  // no process can be started, or no file can be written
    fmt::print(stderr, "The search for a remedy failed: {}\n", e.what());
  }
}

// Names what to do next.
Exit conclude(const Arguments& arguments, simulate::Status status, const fs::path& folder) {
  switch (status) {
    case simulate::Status::done:
      if (!arguments.has(kReport.name)) print_next(arguments, {"trammel", "report", folder.native()});
      return Exit::done;
    case simulate::Status::failed:
      return Exit::failed;
    case simulate::Status::interrupted:
      fmt::print(stderr, "trammel: interrupted; results are in {}, continue with: {}\n", folder.string(),
                 continuation(arguments, folder));
      return Exit::interrupted;
  }
  return Exit::failed;
}

Exit run_scene(const Arguments& arguments) {
  const Output output{arguments.has("--json"), arguments.has("--quiet")};
  simulate::RunOptions options;
  options.out = folder_of_run(arguments);
  options.resume = arguments.has("--resume");
  const BesideResults beside(arguments);
  if (arguments.has(kVerify.name)) analyses();  // missing is said before the run, not after it
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);

  const simulate::ResultsFolder folder(options.out, simulate::Analysis::motion);
  options.command = arguments.command_line();
  options.interrupt = &watch_for_interrupts();
  options.witness = &witness();
  simulate::RunReport report = simulate_visibly(scene, registry, options, output);

  if (output.texts()) print_line(report.summary);
  if (report.status == simulate::Status::failed)
    explain_failure(arguments, registry, report, options.out, output.quiet);
  if (output.json) print_json_text(report.result_json);
  if (arguments.has(kVerify.name) && report.status == simulate::Status::done)
    analyses().verify(arguments, registry, scene, options.out, !output.texts());
  beside.write(options.out, !output.texts());
  return conclude(arguments, report.status, options.out);
}

}  // namespace

Command run_command() {
  return {"run",
          "SCENE",
          "Simulate a scene and write its results.",
          {kOut, kSet, kPlugin, kAllowScenePlugins, kReport, kFormat, kVerify, kVerifyTarget, kResume, kJson, kQuiet},
          run_scene};
}

}  // namespace trammel::tool
