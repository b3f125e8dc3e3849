#include "study/study_results.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulate/results/log_file.hpp"
#include "study/study_page.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

std::string values_of(const Study& study, std::size_t i) {
  std::string text;
  for (const scene::Override& o : study.overrides(i))
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", o.path, o.value);
  return text;
}

json failures(const StudyContent& content) {
  json all = json::array();
  for (const auto& [i, r] : content.records)
    if (!r.done()) all.push_back({{"case", i}, {"values", values_of(content.study, i)}, {"reason", r.reason}});
  return all;
}

// 0, 3 to 7, 9
std::string ranges(const std::vector<std::size_t>& cases) {
  std::string text;
  for (std::size_t i = 0, end = 0; i < cases.size(); i = end) {
    for (end = i + 1; end < cases.size() && cases[end] == cases[end - 1] + 1;) ++end;
    text += text.empty() ? "" : ", ";
    text += end == i + 1 ? fmt::format("{}", cases[i]) : fmt::format("{} to {}", cases[i], cases[end - 1]);
  }
  return text;
}

struct Tally {
  std::size_t done = 0, failed = 0;
  double cpu = 0;
};
Tally tally(const CaseRecords& records) {
  Tally all;
  for (const auto& [i, r] : records) ++(r.done() ? all.done : all.failed), all.cpu += r.cpu;
  return all;
}

std::string sentence(const StudyContent& content) {
  const Tally n = tally(content.records);
  const std::vector<std::size_t> absent = missing(content);
  std::string text = fmt::format("{} of {} cases are done, {} failed", n.done, content.study.size(), n.failed);
  if (content.shard.of > 1) text += fmt::format("; this is shard {} of {}", content.shard.index, content.shard.of);
  if (!absent.empty()) text += fmt::format("; missing: {}", ranges(absent));
  return text;
}

}  // namespace

std::vector<std::size_t> missing(const StudyContent& content) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < content.study.size(); ++i)
    if (content.shard.has(i) && !content.records.contains(i)) all.push_back(i);
  return all;
}

json to_json(const StudyContent& content, const char* status) {
  const Tally n = tally(content.records);
  json all = {{"trammel_study", 1},
              {"status", status},
              {"file", content.file},
              {"scenes", content.study.scene_files()},
              {"scene_hash", fmt::format("{:016x}", content.scene_hash)}};
  all.update(content.made);
  all.update(json{{"shard", {content.shard.index, content.shard.of}},
                  {"cases", content.study.size()},
                  {"done", n.done},
                  {"failed", n.failed},
                  {"missing", missing(content)},
                  {"failures", failures(content)},
                  {"cpu_time_s", n.cpu},
                  {"definition", content.study.resolved()},
                  {"page", report::to_json(page_of(content, sentence(content)))}});
  return all;
}

StudyReport write_results(const StudyContent& content, bool interrupted) {
  using Status = StudyReport::Status;
  const Tally n = tally(content.records);
  StudyReport report;
  report.status = interrupted                               ? Status::interrupted
                  : !missing(content).empty()               ? Status::incomplete
                  : n.done == 0 && !content.records.empty() ? Status::all_failed
                                                            : Status::done;
  constexpr const char* words[] = {"done", "failed", "incomplete", "interrupted"};
  report.json = to_json(content, words[int(report.status)]).dump(2, ' ', false, json::error_handler_t::replace);
  simulate::write_whole(content.folder / "study.csv", csv(content.study, content.records));
  write_npz(content.folder / "study.npz", content.study, content.records);
  simulate::write_whole(content.folder / study_json, report.json + "\n");
  report.summary = sentence(content) + "\n";
  std::size_t shown = 0;
  for (const auto& [i, r] : content.records)
    if (!r.done() && shown++ < 3)
      report.summary += fmt::format("  case {} ({}): {}\n", i, values_of(content.study, i), r.reason);
  report.summary += fmt::format("  {:.3g} s of CPU time; results in {}{}", n.cpu, content.folder.string(),
                                content.study.keep() ? ", each case's in cases/" : "");
  return report;
}

}  // namespace trammel::study
