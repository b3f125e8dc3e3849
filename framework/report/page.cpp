#include "report/page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace trammel::report {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Scale scale) {
  return scale == Scale::linear ? "linear" : "logarithmic";
}

const char* name_of(Mark mark) {
  switch (mark) {
    case Mark::line:
      return "line";
    case Mark::points:
      return "points";
    case Mark::line_and_points:
      return "line and points";
    case Mark::dashed:
      return "dashed";
  }
  return "line";
}

Json to_json(const Axis& axis) {
  return {{"label", axis.label}, {"scale", name_of(axis.scale)}};
}

Json to_json(const std::vector<Point>& points) {
  Json all = Json::array();
  for (const Point& p : points) {
    Json one = Json::array({p.x, p.y});
    if (!p.note.empty()) one.push_back(p.note);
    all.push_back(std::move(one));
  }
  return all;
}

Json to_json(const Curve& curve) {
  return {{"name", curve.name},
          {"mark", name_of(curve.mark)},
          {"points", to_json(curve.points)},
          {"failures", to_json(curve.failures)}};
}

Json to_json(const Figure& figure) {
  Json curves = Json::array();
  for (const Curve& curve : figure.curves) curves.push_back(to_json(curve));
  return {{"title", figure.title},
          {"caption", figure.caption},
          {"x", to_json(figure.x)},
          {"y", to_json(figure.y)},
          {"curves", std::move(curves)}};
}

Json to_json(const Table& table) {
  Json columns = Json::array();
  for (const Column& column : table.columns) columns.push_back({{"name", column.name}, {"unit", column.unit}});
  return {{"title", table.title}, {"columns", std::move(columns)}, {"rows", table.rows}};
}

}  // namespace

Json to_json(const Page& page) {
  Json figures = Json::array(), tables = Json::array();
  for (const Figure& figure : page.figures) figures.push_back(to_json(figure));
  for (const Table& table : page.tables) tables.push_back(to_json(table));
  return {{"title", page.title},
          {"sentences", page.sentences},
          {"figures", std::move(figures)},
          {"tables", std::move(tables)}};
}

}  // namespace trammel::report
