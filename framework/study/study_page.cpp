#include "study/study_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/series.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

constexpr std::size_t most_rows = 200, most_curves = 12;
constexpr std::size_t most_numbers = 40'000;  // of a case's series, reduced to extremes beyond

bool varies(const Study& study, std::size_t path) {
  for (std::size_t i = 1; i < study.size(); ++i)
    if (study.values(i)[path] != study.values(0)[path]) return true;
  return study.size() == 1;
}

// What tells a case from the others: "hht, alpha = -0.15".
std::string label(const Study& study, std::size_t i) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < study.paths().size(); ++k) {
    const std::string value = without_quotes(study.values(i)[k]), &path = study.paths()[k];
    if (value.empty() || !varies(study, k)) continue;
    parts.push_back(path == "scene" ? std::filesystem::path(value).stem().string()
                                    : fmt::format("{} = {}", path.substr(path.rfind('.') + 1), value));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// A column of a kept case over time; no points where the case or the column is missing.
report::Curve curve(const StudyContent& content, std::size_t i, const std::string& column) {
  report::Curve curve{label(content.study, i), report::Mark::line, {}, {}};
  const std::filesystem::path file = content.folder / cases_folder / std::to_string(i) / "series.csv";
  if (std::error_code error; !std::filesystem::exists(file, error)) return curve;
  const report::Series series = report::read_series(file, most_numbers);
  const auto found = std::find(series.names.begin(), series.names.end(), column);
  if (found == series.names.end()) return curve;
  const auto& x = series.columns[0];
  const auto& y = series.columns[std::size_t(found - series.names.begin())];
  for (std::size_t row = 0; row < x.size(); ++row) curve.points.push_back({x[row], y[row], ""});
  return curve;
}

// Of the columns that are reduced, a curve for each case.
std::vector<report::Figure> over_time(const StudyContent& content) {
  std::vector<report::Figure> all;
  std::vector<std::string> drawn;
  for (const Reduction& one : content.study.reductions()) {
    const bool done = std::find(drawn.begin(), drawn.end(), one.observe) != drawn.end();
    if (!content.study.keep() || done || one.observe == "t") continue;
    drawn.push_back(one.observe);
    report::Figure figure{one.observe, "", {"t [s]"}, {one.observe}, {}};
    for (const auto& [i, record] : content.records) {
      if (figure.curves.size() == most_curves) break;
      figure.curves.push_back(curve(content, i, one.observe));
    }
    if (content.records.size() > most_curves)
      figure.caption = fmt::format("The first {} of {} cases.", most_curves, content.records.size());
    all.push_back(std::move(figure));
  }
  return all;
}

// Of one number that varies: each reduction over it.
std::vector<report::Figure> over_the_number(const StudyContent& content) {
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
  report::Table all{"Cases", {{"case", ""}}, {}};
  for (const std::string& path : content.study.paths()) all.columns.push_back({path, ""});
  for (const Reduction& one : content.study.reductions()) all.columns.push_back({one.name, ""});
  all.columns.push_back({"status", ""});
  for (const auto& [i, r] : content.records) {
    if (all.rows.size() == most_rows) break;
    std::vector<std::string>& row = all.rows.emplace_back();
    row.push_back(fmt::format("{}", i));
    for (const std::string& value : content.study.values(i)) row.push_back(without_quotes(value));
    for (const double x : r.values) row.push_back(std::isfinite(x) ? fmt::format("{:.6g}", x) : "");
    row.push_back(r.done() ? r.status : fmt::format("{}: {}", r.status, r.reason));
  }
  return all;
}

}  // namespace

report::Page page_of(const StudyContent& content, const std::string& verdict) {
  const std::string title = content.study.title();
  report::Page page{title.empty() ? content.file : title, {verdict}, over_the_number(content), {table(content)}};
  for (report::Figure& figure : over_time(content)) page.figures.push_back(std::move(figure));
  return page;
}

}  // namespace trammel::study
