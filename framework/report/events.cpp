#include "report/events.hpp"

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "report/csv_line.hpp"

namespace trammel::report {

namespace {

using Json = nlohmann::ordered_json;

// A number, or the text as it is (a cause), or null.
Json value_of(const std::string& cell) {
  if (cell.empty()) return nullptr;
  char* end = nullptr;
  const double x = std::strtod(cell.c_str(), &end);
  if (*end == '\0') return x;
  return cell;
}

// The first three columns, and those of the others that have values.
std::vector<std::size_t> used(const std::vector<std::vector<std::string>>& rows, std::size_t columns) {
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < columns; ++c) {
    bool holds = c < 3;
    for (const auto& row : rows) holds = holds || (c < row.size() && !row[c].empty());
    if (holds) all.push_back(c);
  }
  return all;
}

}  // namespace

Json read_events(const std::filesystem::path& file, std::size_t most_rows) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<std::vector<std::string>> rows;
  long long total = 0;
  Json kinds = Json::object();
  while (std::getline(in, line)) {
    std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 3) continue;  // cut off when the run was killed
    ++total;
    Json& count = kinds[cells[1]];
    count = count.is_null() ? 1LL : count.get<long long>() + 1;
    if (rows.size() < most_rows) rows.push_back(std::move(cells));
  }
  const std::vector<std::size_t> shown = used(rows, names.size());
  Json columns = Json::array(), values = Json::array();
  for (const std::size_t c : shown) columns.push_back(names[c]);
  for (const auto& row : rows) {
    Json one = Json::array();
    for (const std::size_t c : shown) one.push_back(c < row.size() ? value_of(row[c]) : Json(nullptr));
    values.push_back(std::move(one));
  }
  return {{"columns", columns}, {"rows", values}, {"total", total}, {"kinds", kinds}};
}

}  // namespace trammel::report
