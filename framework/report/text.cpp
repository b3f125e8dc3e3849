#include "report/page.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace trammel::report {

namespace {

// A table's rows with columns of equal width.
std::string text(const Table& table) {
  std::vector<std::vector<std::string>> rows = {{}};
  for (const Column& c : table.columns)
    rows[0].push_back(c.unit.empty() || c.unit == "1" ? c.name : fmt::format("{} [{}]", c.name, c.unit));
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> width(table.columns.size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < std::min(row.size(), width.size()); ++i) width[i] = std::max(width[i], row[i].size());
  std::string all = table.title + "\n";
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i)
      line += fmt::format(" {:<{}} ", row[i], i < width.size() ? width[i] : 0);
    line.erase(line.find_last_not_of(' ') + 1);
    all += line + "\n";
  }
  return all;
}

}  // namespace

std::string text(const Page& page) {
  std::string all = page.title + "\n\n";
  for (const std::string& sentence : page.sentences) all += sentence + "\n";
  for (const Table& table : page.tables) all += "\n" + text(table);
  return all;
}

}  // namespace trammel::report
