// trammel run SCENE: simulate and write the results folder.
#include <cerrno>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "arguments.hpp"
#include "crash.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "simulate/simulation.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

constexpr Option kOut{"--out", "DIR", "results folder; default out/<scene name>"};
constexpr Option kResume{"--resume", "DIR", "continue the interrupted run whose results are in DIR"};
constexpr Option kQuiet{"--quiet", "", "no progress, no summary"};

fs::path results_folder(const Arguments& arguments) {
  if (!arguments.has("--resume"))
    return arguments.has("--out") ? fs::path(arguments.last("--out"))
                                  : fs::path("out") / fs::path(arguments.operand()).stem();
  if (arguments.has("--out"))
    throw UsageError("--out and --resume exclude each other: a resumed run goes on in its own folder");
  const fs::path folder = arguments.last("--resume");
  std::error_code error;
  if (!fs::exists(folder / "checkpoint.cbor", error))
    throw UsageError(fmt::format("--resume {0}: there is no {0}/checkpoint.cbor to continue from", folder.string()));
  return folder;
}

// Before a long run starts, not at its first record.
void require_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error && access(folder.c_str(), W_OK | X_OK) != 0) error = {errno, std::generic_category()};
  if (error)
    throw UsageError(
        fmt::format("cannot write results to {}: {}; --out names another folder", folder.string(), error.message()));
}

Exit run(const Arguments& arguments) {
  const bool json = arguments.has("--json");
  const bool quiet = arguments.has("--quiet");
  simulate::RunOptions options;
  options.out = results_folder(arguments);
  options.resume = arguments.has("--resume");
  const scene::Scene scene = load_scene(arguments);
  plugin::Registry registry;
  load_plugins(arguments, registry);

  require_writable(options.out);
  options.interrupt = &watch_for_interrupts();
  options.witness = &watch_for_crashes(json);
  simulate::RunReport report;
  {
    ProgressBar bar(!json && !quiet);
    if (bar.visible()) options.progress = [&bar](const simulate::Progress& progress) { bar.draw(progress); };
    report = simulate::run(scene, registry, options);
  }

  if (json) fmt::print("{}\n", report.result_json);
  if (!json && !quiet) fmt::print("{}\n", report.summary);
  switch (report.status) {
    case simulate::Status::done:
      return Exit::done;
    case simulate::Status::failed:
      fmt::print(stderr, "trammel: {}\nResults up to there are in {}\n", report.reason, options.out.string());
      return Exit::failed;
    case simulate::Status::interrupted:
      fmt::print(stderr, "trammel: interrupted; results are in {0}, continue with: trammel run {1} --resume {0}\n",
                 options.out.string(), arguments.operand());
      return Exit::interrupted;
  }
  return Exit::failed;
}

}  // namespace

Command run_command() {
  return {
      "run", "SCENE", "Simulate a scene and write its results.", {kOut, kSet, kPlugin, kResume, kJson, kQuiet}, run};
}

}  // namespace trammel::tool
