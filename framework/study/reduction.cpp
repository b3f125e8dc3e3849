#include "study/reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/scene_keys.hpp"
#include "report/csv_line.hpp"
#include "scene/files.hpp"
#include "scene/motion_table.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::study {
namespace {

using scene::Problems;
using scene::Value;
using As = Reduction::As;
using Direction = Reduction::Direction;

const std::vector<std::pair<std::string, As>> ways = {
    {"final", As::final},     {"initial", As::initial}, {"max", As::max}, {"min", As::min},
    {"max_abs", As::max_abs}, {"mean", As::mean},       {"rms", As::rms}, {"first_crossing", As::first_crossing}};
const std::vector<std::pair<std::string, Direction>> directions = {
    {"up", Direction::up}, {"down", Direction::down}, {"any", Direction::any}};

template <class T>
std::optional<T> choice(const Value& value, const std::vector<std::pair<std::string, T>>& all, Problems& problems) {
  const auto text = value.read_text(problems);
  if (!text) return std::nullopt;
  std::vector<std::string> names;
  for (const auto& [name, meant] : all) {
    if (name == *text) return meant;
    names.push_back(name);
  }
  problems.error(value.problem(fmt::format("found \"{}\"{}", *text, scene::did_you_mean(*text, names))));
  return std::nullopt;
}

// The rows of a CSV file with a header, as `trammel run` writes: the times of its first column, the values of another.
class ReferenceTable {
 public:
  ReferenceTable(const Value& value, const std::string& file, Problems& problems)
      : value_(value), file_(file), problems_(problems) {
    const auto folder = std::filesystem::path(value.position().file).parent_path();
    path_ = (folder / file).string();
    quotable_ = scene::is_within(folder, path_);
  }

  void read(const std::string& column, Reference& reference) {
    std::istringstream in(scene::read_named_file(path_));
    std::string text;
    std::getline(in, text);
    if (!find_column(cells_in(text), column)) return;
    for (line_ = 2; std::getline(in, text); ++line_)
      if (const std::vector<std::string> row = cells_in(text); row.size() > 1 || !row[0].empty())
        if (!add(row, reference)) return;
    if (reference.t.empty()) problems_.error(value_.problem(fmt::format("{} has no rows", file_)));
  }

 private:
  static std::vector<std::string> cells_in(std::string& line) {
    if (line.ends_with('\r')) line.pop_back();
    return report::cells_of(line);
  }

  bool find_column(const std::vector<std::string>& header, const std::string& column) {
    const auto found = std::find(header.begin(), header.end(), column);
    std::string wrong;
    if (header.front() != "t")
      wrong = fmt::format("the first column of {} is {}, expected \"t\"", file_, quoted(header.front()));
    else if (found == header.end())
      wrong =
          fmt::format("{} has no column \"{}\"{}", file_, column, quotable_ ? scene::did_you_mean(column, header) : "");
    else if (std::count(found, header.end(), column) > 1)
      wrong = fmt::format("{} has more than one column \"{}\"", file_, column);
    if (!wrong.empty()) problems_.error(value_.problem(wrong));
    column_ = std::size_t(found - header.begin());
    return wrong.empty();
  }

  bool add(const std::vector<std::string>& row, Reference& reference) {
    if (row.size() <= column_)
      return refuse(row, row.size() - 1, fmt::format("found {} cells, expected at least {}", row.size(), column_ + 1));
    const auto t = scene::number_of_cell(row[0]), x = scene::number_of_cell(row[column_]);
    if (!t || !x) {
      const std::size_t at = t ? column_ : 0;
      return refuse(row, at, fmt::format("found {}, expected a number", quoted(row[at])));
    }
    if (!reference.t.empty() && *t < reference.t.back())
      return refuse(row, 0, "the time is less than the one in the row before");
    reference.t.push_back(*t);
    reference.x.push_back(*x);
    return true;
  }

  // At the first byte of a cell.
  bool refuse(const std::vector<std::string>& row, std::size_t cell, std::string message) {
    std::size_t column = 1;
    for (std::size_t i = 0; i < cell; ++i) column += row[i].size() + 1;
    problems_.error({{path_, line_, int(column)}, value_.path(), std::move(message)});
    return false;
  }

  // Content of a file outside the study's folder is not shown.
  std::string quoted(const std::string& cell) const {
    return quotable_ ? fmt::format("\"{}\"", scene::shortened(cell)) : "something else";
  }

  const Value& value_;
  const std::string& file_;
  Problems& problems_;
  std::string path_;
  bool quotable_ = true;
  std::size_t column_ = 0;
  int line_ = 1;
};

void read_reference(const Value& value, Reference& reference, Problems& problems) {
  if (value.type() != Value::Type::object) {
    if (const auto x = value.read_number(problems)) reference.constant = *x;
    return;
  }
  if (!model::check_keys(value, {"file", "column"}, problems)) return;
  const Value *file = value.find("file"), *column = value.find("column");
  if (!file || !column) return problems.error(value.problem("expected \"file\" and \"column\""));
  const auto name = file->read_text(problems), which = column->read_text(problems);
  if (!name || !which) return;
  try {
    ReferenceTable(value, *name, problems).read(*which, reference);
  } catch (const scene::SceneError& e) {
    problems.error(file->problem(e.what()));
  }
}

void read_one(const std::string& name, const Value& value, std::vector<Reduction>& all, Problems& problems) {
  if (!model::check_keys(value, {"observe", "as", "level", "direction", "reference"}, problems)) return;
  Reduction one;
  one.name = name;
  const Value *observe = value.find("observe"), *as = value.find("as");
  if (!observe || !as)
    return problems.error(value.problem(fmt::format("expected \"observe\" (a column of the records) and \"as\"")));
  one.observe = observe->read_text(problems).value_or("");
  one.as = choice(*as, ways, problems).value_or(As::final);
  if (const Value* level = value.find("level")) one.level = level->read_number(problems).value_or(0);
  if (const Value* way = value.find("direction"))
    one.direction = choice(*way, directions, problems).value_or(Direction::any);
  if (const Value* reference = value.find("reference")) read_reference(*reference, one.reference, problems);
  for (const char* key : {"level", "direction"})
    if (const Value* given = value.find(key); given && one.as != As::first_crossing)
      problems.error(given->problem("only \"first_crossing\" has one"));
  if (const Value* given = value.find("reference"); given && one.as != As::rms)
    problems.error(given->problem("only \"rms\" has one"));
  all.push_back(std::move(one));
}

bool crosses(double before, double after, Direction way) {
  const bool up = before < 0 && after >= 0, down = before > 0 && after <= 0;
  return (up && way != Direction::down) || (down && way != Direction::up);
}

template <class Combine>
double fold(const std::vector<double>& x, double first, Combine&& combine) {
  return std::accumulate(x.begin(), x.end(), first, combine);
}

// By the trapezoidal rule.
double mean(const std::vector<double>& t, const std::vector<double>& x) {
  double sum = 0, whole = 0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += (x[i] + x[i - 1]) / 2 * (t[i] - t[i - 1]), whole += t[i] - t[i - 1];
  return whole > 0 ? sum / whole : x[0];
}

double first_crossing(const std::vector<double>& t, const std::vector<double>& x, double level, Direction way) {
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double before = x[i - 1] - level, after = x[i] - level;
    if (crosses(before, after, way)) return t[i - 1] + (t[i] - t[i - 1]) * before / (before - after);
  }
  return unknown;
}

}  // namespace

double Reference::at(double time) const {
  if (t.empty()) return constant;
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return x.front();
  if (after == t.end()) return x.back();
  const std::size_t k = std::size_t(after - t.begin());
  return x[k - 1] + (x[k] - x[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
}

double Reduction::of(const Series& s) const {
  const auto column = observe == "t" ? std::optional<std::size_t>() : s.column(observe);
  if (s.rows() == 0 || (!column && observe != "t")) return unknown;
  std::vector<double> x(s.rows());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = column ? s.at(i, *column) : s.t[i];
  switch (as) {
    case As::final:
      return x.back();
    case As::initial:
      return x.front();
    case As::max:
      return fold(x, x.front(), [](double largest, double y) { return std::max(largest, y); });
    case As::min:
      return fold(x, x.front(), [](double least, double y) { return std::min(least, y); });
    case As::max_abs:
      return fold(x, 0, [](double largest, double y) { return std::max(largest, std::abs(y)); });
    case As::mean:
      return mean(s.t, x);
    case As::rms:
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= reference.at(s.t[i]), x[i] *= x[i];
      return std::sqrt(mean(s.t, x));
    case As::first_crossing:
      return first_crossing(s.t, x, level, direction);
  }
  return unknown;
}

std::vector<Reduction> read_reductions(const Value& reduce, Problems& problems) {
  std::vector<Reduction> all;
  if (reduce.type() != Value::Type::object) {
    problems.error(
        reduce.problem(fmt::format("found {}, expected an object of reductions by name", reduce.type_name())));
    return all;
  }
  for (const auto& [name, value] : reduce.members()) read_one(name, value, all, problems);
  return all;
}

}  // namespace trammel::study
