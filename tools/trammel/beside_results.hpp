// Writes additional files beside the results of a run or a static analysis: a report (--report), and formats of other
// tools (--format).
#pragma once

#include <filesystem>
#include <vector>

#include "arguments.hpp"
#include "formats/run_formats.hpp"

namespace trammel::tool {

inline constexpr Option kReport{"--report", "",
                                "write report.html beside the results, to look at: animation, plots, events"};
inline constexpr Option kFormat{
    "--format", "NAME", "write the results also as npz (NumPy) or vtu (ParaView), beside the others (repeatable)"};

class BesideResults {
 public:
  explicit BesideResults(const Arguments& arguments);  // throws UsageError: no such format
  // A failure is reported on standard error; the results are not affected.
  void write(const std::filesystem::path& folder, bool quiet) const;

 private:
  bool report_;
  std::vector<const formats::RunFormat*> formats_;
};

}  // namespace trammel::tool
