#include "study/study_results.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/page.hpp"
#include "simulate/results/log_file.hpp"

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

// Of one number that varies: each reduction over it.
std::vector<report::Figure> figures(const StudyContent& content) {
  std::vector<report::Figure> all;
  if (content.study.paths().size() != 1) return all;
  const std::string& path = content.study.paths()[0];
  for (std::size_t k = 0; k < content.study.reductions().size(); ++k) {
    const std::string& name = content.study.reductions()[k].name;
    report::Curve curve{name, report::Mark::line_and_points, {}, {}};
    for (const auto& [i, r] : content.records) {
      char* end = nullptr;
      const std::string& text = content.study.values(i)[0];
      const double x = std::strtod(text.c_str(), &end);
      if (end != text.c_str() + text.size()) return {};
      (r.done() ? curve.points : curve.failures).push_back({x, r.done() ? r.values[k] : 0, r.reason});
    }
    all.push_back({name, "", {path, report::Scale::linear}, {name, report::Scale::linear}, {curve}});
  }
  return all;
}

report::Table table(const StudyContent& content) {
  constexpr std::size_t most = 200;
  report::Table all{"Cases", {{"case", ""}}, {}};
  for (const std::string& path : content.study.paths()) all.columns.push_back({path, ""});
  for (const Reduction& one : content.study.reductions()) all.columns.push_back({one.name, ""});
  all.columns.push_back({"status", ""});
  for (const auto& [i, r] : content.records) {
    if (all.rows.size() == most) break;
    std::vector<std::string>& row = all.rows.emplace_back();
    row.push_back(fmt::format("{}", i));
    for (const std::string& value : content.study.values(i)) row.push_back(value);
    for (const double x : r.values) row.push_back(fmt::format("{:.6g}", x));
    row.push_back(r.status);
  }
  return all;
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
  const report::Page page{content.file, {sentence(content)}, figures(content), {table(content)}};
  json all = {{"trammel_study", 1},
              {"status", status},
              {"file", content.file},
              {"scene", content.study.scene_file()},
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
                  {"page", report::to_json(page)}});
  return all;
}

StudyReport write_results(const StudyContent& content, const std::filesystem::path& folder, bool interrupted) {
  using Status = StudyReport::Status;
  const Tally n = tally(content.records);
  StudyReport report;
  report.status = interrupted                               ? Status::interrupted
                  : !missing(content).empty()               ? Status::incomplete
                  : n.done == 0 && !content.records.empty() ? Status::all_failed
                                                            : Status::done;
  constexpr const char* words[] = {"done", "failed", "incomplete", "interrupted"};
  report.json = to_json(content, words[int(report.status)]).dump(2, ' ', false, json::error_handler_t::replace);
  simulate::write_whole(folder / "study.csv", csv(content.study, content.records));
  write_npz(folder / "study.npz", content.study, content.records);
  simulate::write_whole(folder / study_json, report.json + "\n");
  report.summary = sentence(content) + "\n";
  std::size_t shown = 0;
  for (const auto& [i, r] : content.records)
    if (!r.done() && shown++ < 3)
      report.summary += fmt::format("  case {} ({}): {}\n", i, values_of(content.study, i), r.reason);
  report.summary += fmt::format("  {:.3g} s of CPU time; results in {}", n.cpu, folder.string());
  return report;
}

}  // namespace trammel::study
