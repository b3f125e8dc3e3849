#include "study/study_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/series.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

constexpr std::size_t most_rows = 200, most_curves = 12;
constexpr std::size_t most_numbers = 40'000;  // of a case's series; longer ones are reduced to extremes

bool varies(const Study& study, const std::vector<std::size_t>& cases, std::size_t path) {
  for (const std::size_t i : cases)
    if (study.values(i)[path] != study.values(cases.front())[path]) return true;
  return false;
}

// The values that distinguish a case from the others: "hht, alpha = -0.15".
std::string label(const Study& study, const std::vector<std::size_t>& cases, std::size_t i) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < study.paths().size(); ++k) {
    const std::string value = without_quotes(study.values(i)[k]), &path = study.paths()[k];
    if (value.empty() || !varies(study, cases, k)) continue;
    parts.push_back(path == "scene" ? std::filesystem::path(value).stem().string()
                                    : fmt::format("{} = {}", path.substr(path.rfind('.') + 1), value));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// A column of a kept case over time; no points where the case or the column is missing.
report::Curve curve(const StudyContent& content, std::size_t i, const std::string& column, std::string name) {
  report::Curve curve{std::move(name), report::Mark::line, {}, {}};
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

// Without figures of its own a study shows the columns that are reduced, of all cases.
std::vector<StudyFigure> figures_of(const Study& study) {
  if (!study.figures().empty() || !study.keep()) return study.figures();
  std::vector<StudyFigure> all;
  std::vector<std::size_t> cases(study.size());
  std::iota(cases.begin(), cases.end(), 0);
  for (const Reduction& one : study.reductions()) {
    const auto shows = [&](const StudyFigure& other) { return other.title == one.observe; };
    if (one.observe != "t" && std::none_of(all.begin(), all.end(), shows))
      all.push_back({.title = one.observe, .observe = {one.observe}, .cases = cases});
  }
  return all;
}

// A logarithmic axis cannot show 0, such as a norm of rows while no contact is closed.
void remove_zeros(report::Curve& curve, const StudyFigure& figure) {
  std::erase_if(curve.points,
                [&](const report::Point& p) { return (figure.log && !(p.y > 0)) || (figure.log_time && !(p.x > 0)); });
}

report::Figure over_time(const StudyContent& content, const StudyFigure& wanted) {
  const auto scale = [](bool log) { return log ? report::Scale::logarithmic : report::Scale::linear; };
  const std::string columns = fmt::format("{}", fmt::join(wanted.observe, ", "));
  report::Figure figure{wanted.title.empty() ? columns : wanted.title,
                        "",
                        {"t [s]", scale(wanted.log_time)},
                        {columns, scale(wanted.log)},
                        {}};
  std::vector<std::size_t> there;
  for (const std::size_t i : wanted.cases)
    if (content.records.contains(i)) there.push_back(i);
  for (const std::size_t i : there)
    for (const std::string& column : wanted.observe) {
      if (figure.curves.size() == most_curves) continue;
      std::vector<std::string> name;
      if (there.size() > 1) name.push_back(label(content.study, there, i));
      if (wanted.observe.size() > 1 || there.size() == 1) name.push_back(column);
      figure.curves.push_back(curve(content, i, column, fmt::format("{}", fmt::join(name, ", "))));
      remove_zeros(figure.curves.back(), wanted);
    }
  if (const std::size_t all = there.size() * wanted.observe.size(); all > most_curves)
    figure.caption = fmt::format("The first {} of {} curves.", most_curves, all);
  return figure;
}

// If one number varies: each reduction as a function of it.
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
  for (const StudyFigure& figure : figures_of(content.study)) page.figures.push_back(over_time(content, figure));
  return page;
}

}  // namespace trammel::study
