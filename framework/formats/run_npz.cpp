// series.npz: one array per column of series.csv, under its name, and "columns" and "units" in the order of the columns.
// events.npz: the columns of events.csv, texts and numbers; a number that an event does not have is NaN.
#include <limits>

#include <nlohmann/json.hpp>

#include "formats/run_formats.hpp"
#include "report/events.hpp"
#include "report/json_file.hpp"
#include "report/series.hpp"
#include "simulate/results/npz.hpp"

namespace trammel::formats {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using simulate::NpzFile;

constexpr auto everything = std::numeric_limits<std::size_t>::max();

std::vector<std::string> units_of(const std::vector<std::string>& names, const Json& result) {
  std::vector<std::string> units(names.size());
  if (const Json* columns = report::find(result, {"columns", "series"}))
    for (const Json& column : *columns)
      for (std::size_t i = 0; i < names.size(); ++i)
        if (column.value("name", "") == names[i]) units[i] = column.value("unit", "");
  return units;
}

void write_series(const fs::path& folder, const fs::path& file) {
  const report::Series series = report::read_series(folder / "series.csv", everything);
  NpzFile npz(file);
  for (std::size_t c = 0; c < series.names.size(); ++c)
    npz.add(series.names[c], {series.columns[c].size()}, std::span<const double>(series.columns[c]));
  std::error_code error;
  const Json result = fs::exists(folder / "result.json", error) ? report::json_file(folder / "result.json") : Json();
  const std::vector<std::string> units = units_of(series.names, result);
  npz.add("columns", std::span<const std::string>(series.names));
  npz.add("units", std::span<const std::string>(units));
  npz.close();
}

void write_events(const fs::path& folder, const fs::path& file) {
  const Json events = report::read_events(folder / "events.csv", everything);
  NpzFile npz(file);
  for (std::size_t c = 0; c < events["columns"].size(); ++c) {
    const std::string name = events["columns"][c];
    std::vector<std::string> texts;
    std::vector<double> numbers;
    bool is_text = c == 1 || c == 2 || name == "cause";
    for (const Json& row : events["rows"]) {
      texts.push_back(row[c].is_string() ? row[c].get<std::string>() : "");
      numbers.push_back(row[c].is_number() ? row[c].get<double>() : std::numeric_limits<double>::quiet_NaN());
    }
    if (is_text)
      npz.add(name, std::span<const std::string>(texts));
    else
      npz.add(name, {numbers.size()}, std::span<const double>(numbers));
  }
  npz.close();
}

}  // namespace

fs::path write_npz(const fs::path& folder) {
  write_events(folder, folder / "events.npz");
  write_series(folder, folder / "series.npz");
  return folder / "series.npz";
}

}  // namespace trammel::formats
