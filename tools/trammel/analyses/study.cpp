// trammel study STUDY.json, and trammel study merge DIR...: many runs of one scene, and their results folder.
#include <csignal>

#include <fmt/format.h>

#include "arguments.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "last_words.hpp"
#include "next.hpp"
#include "progress.hpp"
#include "results_folder.hpp"
#include "study/study_run.hpp"

namespace trammel::tool {

namespace {

using study::StudyReport;

constexpr Option kStudyFolder{"--out", "DIR", "results folder; default out/<study name>, with _I_of_N for a shard"};
constexpr Option kShard{"--shard", "I/N", "only part I (from 1) of N: one task of an array on a cluster"};
constexpr Option kEstimate{"--estimate", "", "run three cases, and propose the number of shards for a minute each"};

study::Shard shard_of(const Arguments& arguments) {
  if (!arguments.has(kShard.name)) return {};
  const std::string& text = arguments.last(kShard.name);
  const char* expected = "I/N with 1 <= I <= N, e.g. 3/40";
  const auto slash = text.find('/');
  if (slash == text.npos) throw UsageError(fmt::format("--shard {}: expected {}", text, expected));
  const study::Shard shard{whole_number(kShard, text.substr(0, slash), expected),
                           whole_number(kShard, text.substr(slash + 1), expected)};
  if (shard.index > shard.of) throw UsageError(fmt::format("--shard {}: expected {}", text, expected));
  return shard;
}

// SIGTERM and the limit of CPU time come from a batch system, which starts the task again.
Exit exit_of(StudyReport::Status status) {
  switch (status) {
    case StudyReport::Status::done:
      return Exit::done;
    case StudyReport::Status::interrupted:
      return interrupting_signal() == SIGTERM || interrupting_signal() == SIGXCPU ? Exit::requeue : Exit::interrupted;
    default:
      return Exit::failed;
  }
}

Exit reported(const Arguments& arguments, const StudyReport& report, const std::filesystem::path* folder) {
  if (arguments.has(kJson.name))
    print_json_text(report.json);
  else if (!arguments.has(kQuiet.name))
    print_line(report.summary);
  if (report.status == StudyReport::Status::interrupted)
    fmt::print(stderr, "trammel: interrupted; the same command runs the cases that are missing\n");
  if (report.status == StudyReport::Status::incomplete)
    fmt::print(stderr, "trammel: cases are missing; {}\n",
               arguments.operand() == "merge" ? "run the shards that have them" : "the same command runs them");
  if (report.status == StudyReport::Status::done && folder)
    print_next(arguments, {"trammel", "report", folder->native()});
  return exit_of(report.status);
}

study::StudyOptions options_of(const Arguments& arguments) {
  study::StudyOptions options;
  options.shard = shard_of(arguments);
  if (arguments.has(kJobs.name))
    options.jobs = whole_number(kJobs, arguments.last(kJobs.name), "a whole number from 1");
  options.command = arguments.command_line();
  options.witness = &witness();
  return options;
}

Exit merge(const Arguments& arguments) {
  std::vector<std::filesystem::path> folders(arguments.operands().begin() + 1, arguments.operands().end());
  if (folders.empty()) throw UsageError("'trammel study merge' needs the folders of the shards");
  if (!arguments.has("--out")) throw UsageError("'trammel study merge' needs --out DIR for the joined results");
  study::StudyOptions options = options_of(arguments);
  options.out = arguments.last("--out");
  const simulate::ResultsFolder folder(options.out, simulate::Analysis::study);
  return reported(arguments, study::merge_studies(folders, options), &options.out);
}

Exit run_study(const Arguments& arguments) {
  if (arguments.operand() == "merge") return merge(arguments);
  if (arguments.operands().size() > 1)
    throw UsageError(fmt::format("'trammel study' takes one study, found also '{}'", arguments.operands()[1]));
  const study::Study study = study::Study::load(arguments.operand(), overrides_of(arguments));
  plugin::Registry registry;
  load_plugins(arguments, registry);
  if (arguments.has(kEstimate.name)) return reported(arguments, study::estimate_study(study, registry), nullptr);
  study::StudyOptions options = options_of(arguments);
  const std::string ending =
      options.shard.of > 1 ? fmt::format("_{}_of_{}", options.shard.index, options.shard.of) : "";
  options.out = results_folder(arguments, ending.c_str());
  const simulate::ResultsFolder folder(options.out, simulate::Analysis::study);
  options.interrupt = &watch_for_interrupts();
  ProgressBar bar(!arguments.has(kJson.name) && !arguments.has(kQuiet.name));
  options.progress = [&bar](std::size_t done, std::size_t of) {
    bar.draw(double(done) / double(of), fmt::format("{} of {} cases", done, of));
  };
  const StudyReport report = study::run_study(study, arguments.operand(), registry, options);
  bar.clear();
  return reported(arguments, report, &options.out);
}

}  // namespace

Command study_command() {
  return {"study",
          "STUDY",
          "Run a scene with many values, as a study file says; 'study merge DIR... --out DIR' joins shards.",
          {kStudyFolder, kSet, kShard, kJobs, kEstimate, kPlugin, kAllowScenePlugins, kJson, kQuiet},
          run_study,
          1'000'000};
}

}  // namespace trammel::tool
