#include "scene/motion_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "scene/files.hpp"
#include "scene/laws/tabulated_law.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {
namespace {

constexpr std::size_t fewest_rows = 4;                        // of a table
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // which spreadsheets put before UTF-8

using Cells = std::vector<std::string_view>;
using Header = std::vector<std::string>;  // names of columns

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// Position of the first of these characters outside double quotes, from `at` on.
std::size_t find_unquoted(std::string_view line, std::string_view characters, std::size_t at = 0) {
  for (bool quoted = false; at < line.size(); ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (!quoted && characters.find(line[at]) != characters.npos) return at;
  }
  return line.npos;
}

std::string_view unquoted(std::string_view cell) {
  const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

// A double quote within a name in double quotes is written twice.
Header header_of(const Cells& cells) {
  Header header;
  for (const std::string_view cell : cells) {
    std::string& name = header.emplace_back();
    for (std::size_t i = 0; i < cell.size(); ++i) {
      name += cell[i];
      if (cell.substr(i).starts_with("\"\"")) ++i;
    }
  }
  return header;
}

// Splits at commas if there are any, else at semicolons, else at blanks. A cell may be in double quotes.
Cells cells_of(std::string_view line) {
  const char separator = find_unquoted(line, ",") != line.npos   ? ','
                         : find_unquoted(line, ";") != line.npos ? ';'
                                                                 : ' ';
  Cells cells;
  for (std::size_t at = 0; at <= line.size();) {
    const auto end = find_unquoted(line, separator == ' ' ? " \t" : std::string_view(&separator, 1), at);
    const auto cell = unquoted(trimmed(line.substr(at, std::min(end, line.size()) - at)));
    if (separator != ' ' || !cell.empty()) cells.push_back(cell);
    at = end == line.npos ? line.size() + 1 : end + 1;
  }
  return cells;
}

class Table {
 public:
  Table(const Value& object, Problems& problems) : object_(object), problems_(problems) {}

  std::optional<TimeFunction> read() {
    static const std::vector<std::string> keys = {"table", "time", "column", "holds", "scale", "beyond"};
    for (const auto& [key, value] : object_.members())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        problems_.error(value.problem(fmt::format("unknown key \"{}\"{}", key, did_you_mean(key, keys))));
    const Value* table = object_.find("table");
    if (!table) {
      problems_.error(
          object_.problem("found an object, expected a number, an expression of t or {\"table\": FILE, ...}"));
      return {};
    }
    const auto name = table->read_text(problems_);
    if (!name || !read_options()) return {};
    const auto folder = std::filesystem::path(table->position().file).parent_path();
    file_ = (folder / *name).string();
    quotable_ = is_within(folder, file_);
    try {
      text_ = read_named_file(file_);
    } catch (const SceneError& error) {
      problems_.error(table->problem(fmt::format("cannot read the table \"{}\": {}", *name, error.what())));
      return {};
    }
    if (!read_rows()) return {};
    auto law = accelerations_ ? TabulatedLaw::of_accelerations(std::move(t_), std::move(x_), beyond_)
                              : TabulatedLaw::of_values(std::move(t_), std::move(x_), beyond_);
    return TimeFunction(std::make_shared<const TabulatedLaw>(std::move(law)), fmt::format("table {}", *name));
  }

 private:
  bool read_options() {
    if (const Value* holds = object_.find("holds")) {
      const auto text = holds->read_text(problems_);
      if (!text) return false;
      if (*text != "values" && *text != "accelerations") {
        problems_.error(holds->problem(fmt::format("found \"{}\", expected \"values\" or \"accelerations\"", *text)));
        return false;
      }
      accelerations_ = *text == "accelerations";
    }
    if (const Value* beyond = object_.find("beyond"); beyond && !read_beyond(*beyond)) return false;
    if (const Value* scale = object_.find("scale")) {
      const auto factor = scale->read_number(problems_);
      if (!factor) return false;
      scale_ = *factor;
    }
    return true;
  }

  bool read_beyond(const Value& value) {
    const auto text = value.read_text(problems_);
    if (!text) return false;
    using Beyond = TabulatedLaw::Beyond;
    for (const auto& [name, beyond] :
         {std::pair{"hold", Beyond::hold}, {"zero", Beyond::zero}, {"repeat", Beyond::repeat}}) {
      if (*text != name) continue;
      beyond_ = beyond;
      return true;
    }
    problems_.error(value.problem(fmt::format("found \"{}\", expected \"hold\", \"zero\" or \"repeat\"{}", *text,
                                              did_you_mean(*text, {"hold", "zero", "repeat"}))));
    return false;
  }

  bool read_rows() {
    int line_number = 0;
    bool first = true;
    for (std::size_t at = text_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; at < text_.size();) {
      const auto end = std::min(text_.find('\n', at), text_.size());
      const auto line = trimmed(std::string_view(text_).substr(at, end - at));
      at = end + 1;
      ++line_number;
      if (line.empty() || line.starts_with('#')) continue;
      if (std::count(line.begin(), line.end(), '"') % 2 != 0)
        return complain(line_number, "a double quote is not closed on its line");
      const Cells cells = cells_of(line);
      if (std::exchange(first, false)) {
        const bool names =
            std::none_of(cells.begin(), cells.end(), [](auto cell) { return number_of_cell(cell).has_value(); });
        const Header header = names ? header_of(cells) : Header();
        if (!find_column("time", 1, header, cells.size(), time_) ||
            !find_column("column", 2, header, cells.size(), column_))
          return false;
        if (time_ == column_) return refuse_time_as_data(header);
        if (names) continue;
      }
      if (!add_row(cells, line_number)) return false;
    }
    if (t_.size() >= fewest_rows) return true;
    return complain(line_number, fmt::format("found {} rows, expected at least {}", t_.size(), fewest_rows));
  }

  bool refuse_time_as_data(const Header& header) {
    const Value* column = object_.find("column");
    const Value* named = column ? column : object_.find("time");
    const bool by_name = quotable_ && !header.empty();
    const std::string which = by_name ? fmt::format("\"{}\"", header[time_]) : fmt::format("{}", time_ + 1);
    problems_.error(
        (named ? *named : object_)
            .problem(fmt::format("column {} of {} is taken for the time and for what moves; \"time\" is column 1 "
                                 "and \"column\" is column 2 unless they are named",
                                 which, file_)));
    return false;
  }

  // A column by its name in the header or its number from 1; the index from 0.
  bool find_column(const char* key, int fallback, const Header& header, std::size_t count, std::size_t& index) {
    const Value* value = object_.find(key);
    if (value && value->type() == Value::Type::text && !value->text().starts_with("=")) {
      const auto found = std::find(header.begin(), header.end(), value->text());
      index = std::size_t(found - header.begin());
      if (std::count(header.begin(), header.end(), value->text()) > 1) {
        problems_.error(value->problem(
            fmt::format("{} has more than one column \"{}\"; give the number of the one that is meant, from 1", file_,
                        value->text())));
        return false;
      }
      if (found != header.end()) return true;
      problems_.error(value->problem(
          header.empty() ? fmt::format("{} has no line that names its columns, so give a number from 1", file_)
                         : fmt::format("{} has no column \"{}\"{}", file_, value->text(),
                                       quotable_ ? did_you_mean(value->text(), header) : "")));
      return false;
    }
    const std::optional<int> number = value ? value->read_integer(problems_) : fallback;
    if (!number) return false;
    index = std::size_t(*number - 1);
    if (*number >= 1 && index < count) return true;
    problems_.error((value ? *value : object_)
                        .problem(fmt::format("found column {}, but {} has columns 1 to {}", *number, file_, count)));
    return false;
  }

  bool add_row(const Cells& cells, int line) {
    if (cells.size() <= std::max(time_, column_))
      return complain(line,
                      fmt::format("found {} cells, expected at least {}", cells.size(), std::max(time_, column_) + 1));
    const auto t = number_of_cell(cells[time_]), x = number_of_cell(cells[column_]);
    if (!t || !x) {
      const std::string found =
          quotable_ ? fmt::format("\"{}\"", shortened(cells[t ? column_ : time_])) : "something else";
      return complain(line, fmt::format("found {}, expected a number", found));
    }
    if (!t_.empty() && !(*t > t_.back()))
      return complain(line, quotable_
                                ? fmt::format("the time {} does not come after {} in the row before", *t, t_.back())
                                : "the time does not come after the one in the row before");
    t_.push_back(*t);
    x_.push_back(scale_ * *x);
    return true;
  }

  bool complain(int line, std::string message) {
    problems_.error({{file_, line, 1}, object_.path(), std::move(message)});
    return false;
  }

  const Value& object_;
  Problems& problems_;
  std::string file_, text_;
  bool quotable_ = true;  // true for a table in the folder of the file that names it; other tables are not quoted
  bool accelerations_ = false;
  double scale_ = 1;
  TabulatedLaw::Beyond beyond_ = TabulatedLaw::Beyond::unsaid;
  std::size_t time_ = 0, column_ = 1;
  std::vector<double> t_, x_;
};

}  // namespace

std::optional<double> number_of_cell(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double x = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(x)) return {};
  return x;
}

std::optional<TimeFunction> read_motion_table(const Value& object, Problems& problems) {
  return Table(object, problems).read();
}

}  // namespace trammel::scene
