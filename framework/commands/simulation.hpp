// Runs a scene: builds the model, advances it, and writes the results folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "plugin/registry.hpp"
#include "run/interrupt.hpp"
#include "scene/value.hpp"

namespace trammel::simulate {

struct Progress {
  double t = 0, until = 0;  // [s] simulated
  long long steps = 0;
  int impacts = 0;
  long long events = 0;
  double step = 0;  // [s] mean since the last call; 0: unknown
};

class CrashWitness;

struct RunOptions {
  std::filesystem::path out;                      // results folder, made if missing
  bool resume = false;                            // continue from out/checkpoint.cbor
  Interrupt* interrupt = nullptr;                 // from a signal handler: stop after this step, keep everything
  std::vector<std::string> command;               // the words of the command line, for result.json
  CrashWitness* witness = nullptr;                // follows the run for a handler of crashes
  std::function<void(const Progress&)> progress;  // called about ten times a second of wall-clock time
  std::function<void(const std::string&)> warn;   // called at once for warnings that matter before the run ends
};

enum class Status { done, failed, interrupted };

struct RunReport {
  Status status = Status::done;
  std::string reason;              // why it failed: time, step and cause
  double t = 0, cpu = 0;           // [s] reached; of CPU time
  std::optional<State> last_good;  // Simulator::last_good
  bool no_motion = false;          // it failed because no motion was found, which another method may find
  std::string result_json;         // as written to out/result.json
  std::string summary;  // a few lines for a person: what was simulated, impacts, energy by cause, norms, cost, where
};

// Throws scene::SceneError for bad input, plugin::PluginError for a plugin that misbehaves (results so far are kept).
RunReport run(const scene::Scene& scene, plugin::Registry& registry, const RunOptions& options);

// Reads everything and builds the model without running; throws like run. Returns warnings, a line each.
std::string validate(const scene::Scene& scene, plugin::Registry& registry, CrashWitness* witness = nullptr);

// What was built, what each part costs, what was left out: sentences for a person under titles.
struct ExplainedPart {
  std::string title;
  std::vector<std::string> lines;
};
std::vector<ExplainedPart> explain(const scene::Scene& scene, plugin::Registry& registry,
                                   CrashWitness* witness = nullptr);
std::string text_of(const std::vector<ExplainedPart>& parts);  // titles, and under each its lines, indented

}  // namespace trammel::simulate
