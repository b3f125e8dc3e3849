#include "analyses/after_run.hpp"

#include <optional>

#include <fmt/format.h>

#include "input.hpp"
#include "interrupt.hpp"
#include "study/evidence/remedy.hpp"
#include "study/evidence/verification.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

study::SceneSource source_of(const Arguments& arguments) {
  return study::SceneSource(arguments.operand(), overrides_of(arguments));
}

}  // namespace

void verify(const Arguments& arguments, plugin::Registry& registry, const scene::Scene& scene, const fs::path& folder,
            bool quiet) {
  std::optional<double> target;
  if (arguments.has(kVerifyTarget.name)) target = positive(arguments, kVerifyTarget);
  const study::CaseResult done = study::read_run(folder, scene);
  const study::Verification verification = study::verify(source_of(arguments), registry, done, target);
  study::record(verification, folder);
  if (quiet) return;
  print_line(fmt::format("Verified at {:.2g} times the run's own cost:", verification.price));
  for (const std::string& sentence : verification.sentences()) print_line("  " + sentence);
}

void find_remedy(const Arguments& arguments, plugin::Registry& registry, simulate::RunReport& report,
                 const fs::path& folder) {
  constexpr double long_wait = 5;  // [s]
  const double limit = study::search_limit(report.cpu);
  if (limit > long_wait)
    fmt::print(stderr,
               "Trying changes of the scene that get past there, for {:.0f} s of CPU time at most (Ctrl-C ends "
               "the search)\n",
               limit);
  const study::RemedySearch search = study::find_remedy(source_of(arguments), registry, {report.t, report.last_good},
                                                        {limit, &watch_for_interrupts()});
  std::string sets;
  if (search.remedy)
    for (const scene::Override& o : search.remedy->overrides) sets += " --set " + shell_quoted(o.path + "=" + o.value);
  fmt::print(stderr, "{}{}{}\n", search.sentence(), sets.empty() ? "" : ":", sets);
  report.result_json = study::record(search, folder);
}

}  // namespace trammel::tool
