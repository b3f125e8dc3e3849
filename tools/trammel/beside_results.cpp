#include "beside_results.hpp"

#include <fmt/format.h>

#include "input.hpp"
#include "report/report.hpp"
#include "scene/suggestion.hpp"
#include "simulate/results/log_file.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

const formats::RunFormat* format_named(const std::string& name) {
  std::vector<std::string> names;
  for (const formats::RunFormat& format : formats::run_formats()) names.emplace_back(format.name);
  const formats::RunFormat* found = formats::find_run_format(name);
  if (!found)
    throw UsageError(fmt::format("--format {}: there is no such format{}", name, scene::did_you_mean(name, names)));
  return found;
}

void write_format(const formats::RunFormat& format, const fs::path& folder, bool quiet) {
  try {
    const fs::path file = format.write(folder);
    if (!quiet) print_line(fmt::format("As {}: {}", format.name, file.string()));
  } catch (const std::exception& e) {
    fmt::print(stderr, "trammel: no {} was written: {}\n", format.name, e.what());
  }
}

void write_report(const fs::path& folder, bool quiet) {
  const fs::path file = folder / "report.html";
  try {
    simulate::write_whole(file, report::report({folder}));
    if (!quiet) print_line(fmt::format("To look at it, open {}", file.string()));
  } catch (const std::exception& e) {
    fmt::print(stderr, "trammel: no report was written: {}\n", e.what());
  }
}

}  // namespace

BesideResults::BesideResults(const Arguments& arguments) : report_(arguments.has(kReport.name)) {
  for (const std::string& name : arguments.all(kFormat.name)) formats_.push_back(format_named(name));
}

void BesideResults::write(const fs::path& folder, bool quiet) const {
  for (const formats::RunFormat* format : formats_) write_format(*format, folder, quiet);
  if (report_) write_report(folder, quiet);
}

}  // namespace trammel::tool
