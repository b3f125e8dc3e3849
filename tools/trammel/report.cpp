// trammel report DIR...: one HTML file to look at.
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "input.hpp"
#include "next.hpp"
#include "report/report.hpp"
#include "simulate/results/log_file.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

constexpr Option kFile{"--out", "FILE", "the file to write; default report.html in the first folder"};

fs::path file_of(const Arguments& arguments) {
  if (arguments.has("--out")) return arguments.last("--out");
  const fs::path first = arguments.operand();
  std::error_code error;
  return fs::is_directory(first, error) ? first / "report.html" : fs::path(first).replace_extension(".html");
}

Exit run_report(const Arguments& arguments) {
  std::vector<fs::path> what;
  for (const std::string& operand : arguments.operands()) what.emplace_back(operand);
  const fs::path file = file_of(arguments);
  try {
    simulate::write_whole(file, report::report(what));
  } catch (const report::ReportRefused& e) {
    throw UsageError(e.what());
  }
  if (arguments.has("--json"))
    print_json({{"status", "done"}, {"report", file.string()}});
  else
    print_line(file.string());
  print_next(arguments, {"xdg-open", file.native()});
  return Exit::done;
}

}  // namespace

Command report_command() {
  return {"report",
          "DIR...",
          "Write one HTML file to look at: animation, plots, events. Several runs are overlaid.",
          {kFile, kJson},
          run_report,
          std::numeric_limits<std::size_t>::max()};
}

}  // namespace trammel::tool
