// report::Page through a pipe: its own JSON, and that read again.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "testing/kit/page.hpp"

namespace trammel::kit {

namespace {

using Json = nlohmann::ordered_json;

report::Axis axis_of(const Json& j) {
  return {j.at("label"), j.at("scale") == "linear" ? report::Scale::linear : report::Scale::logarithmic};
}

report::Mark mark_of(const std::string& name) {
  if (name == "line") return report::Mark::line;
  if (name == "points") return report::Mark::points;
  return name == "dashed" ? report::Mark::dashed : report::Mark::line_and_points;
}

std::vector<report::Point> points_of(const Json& j) {
  std::vector<report::Point> all;
  for (const Json& p : j) all.push_back({p[0], p[1], p.size() > 2 ? p[2].get<std::string>() : ""});
  return all;
}

report::Figure figure_of(const Json& j) {
  report::Figure figure{j.at("title"), j.at("caption"), axis_of(j.at("x")), axis_of(j.at("y")), {}};
  for (const Json& c : j.at("curves"))
    figure.curves.push_back(
        {c.at("name"), mark_of(c.at("mark")), points_of(c.at("points")), points_of(c.at("failures"))});
  return figure;
}

report::Table table_of(const Json& j) {
  report::Table table{j.at("title"), {}, {}};
  for (const Json& c : j.at("columns")) table.columns.push_back({c.at("name"), c.at("unit")});
  table.rows = j.at("rows").get<std::vector<std::vector<std::string>>>();
  return table;
}

}  // namespace

std::string text_of(const report::Page& page) {
  return report::to_json(page).dump(-1, ' ', false, Json::error_handler_t::replace);
}

report::Page page_of_text(const std::string& text) {
  const Json j = Json::parse(text);
  report::Page page{j.at("title"), j.at("sentences").get<std::vector<std::string>>(), {}, {}};
  for (const Json& f : j.at("figures")) page.figures.push_back(figure_of(f));
  for (const Json& t : j.at("tables")) page.tables.push_back(table_of(t));
  return page;
}

}  // namespace trammel::kit
