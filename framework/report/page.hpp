// A page of a report: sentences, figures and tables, as the commands that measure something (check, trade, study,
// stability, modes) hand them over. They write it under "page" of their JSON; `html` makes one self-contained file of it.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace trammel::report {

enum class Scale { linear, logarithmic };

// [1] An error of 0 has no place on a logarithmic axis: it is drawn here, below round-off.
inline constexpr double least_drawn = 1e-17;

struct Axis {
  std::string label;  // with its unit: "step h [s]"
  Scale scale = Scale::linear;
};

enum class Mark { line, points, line_and_points, dashed };

struct Point {
  double x = 0, y = 0;
  std::string note;  // shown with the point, e.g. the settings of the run
};

struct Curve {
  std::string name;
  Mark mark = Mark::line_and_points;
  std::vector<Point> points;
  std::vector<Point> failures;  // runs that gave no y: drawn at the margin of their x, with their note
};

struct Figure {
  std::string title, caption;
  Axis x, y;
  std::vector<Curve> curves;
};

struct Column {
  std::string name, unit;  // unit "" for texts and numbers without one
};

struct Table {
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  // as printed; a row per line
};

struct Page {
  std::string title;
  std::vector<std::string> sentences;  // the verdict first
  std::vector<Figure> figures;
  std::vector<Table> tables;
};

nlohmann::ordered_json to_json(const Page& page);
// Sentences and tables for a terminal; figures are left out.
std::string text(const Page& page);
// One HTML file that loads nothing else.
std::string html(const Page& page);

}  // namespace trammel::report
