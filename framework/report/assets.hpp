// The style sheet and the scripts of a report, which the build embeds: the files of report/assets, and dygraphs.
#pragma once

#include <string_view>

namespace trammel::report {

// "report.css", "figure.js", "dygraph.min.js", ...; empty if there is no such file, or no dygraphs when it was built.
std::string_view asset(std::string_view name);

}  // namespace trammel::report
