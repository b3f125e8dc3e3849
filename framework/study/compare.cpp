#include "study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "report/csv_line.hpp"
#include "simulate/results/results_folder.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double all_digits = 17;

struct Difference {
  std::string file, where, a, b;        // where: "row 12 (t = 0.011), column theta", or a JSON path
  std::optional<double> digits, least;  // shared digits: of the first pair; of the worst pair of the file
  std::size_t count = 0;                // of values that differ
};

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  return text.empty() || end != text.c_str() + text.size() ? std::nullopt : std::optional(x);
}

// Digits relative to the larger number, or to `scale` if that is more.
std::optional<double> digits(const std::string& a, const std::string& b, double scale) {
  const auto x = number(a), y = number(b);
  if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) return std::nullopt;
  if (*x == *y) return all_digits;
  const double relative = std::abs(*x - *y) / std::max({std::abs(*x), std::abs(*y), scale});
  return std::max(0.0, std::min(-std::log10(relative), all_digits));
}

void note(Difference& d, const std::string& where, const std::string& a, const std::string& b, double scale = 0) {
  const std::optional<double> shared = digits(a, b, scale);
  if (d.count++ == 0) d.where = where, d.a = a, d.b = b, d.digits = d.least = shared;
  if (shared && d.least) d.least = std::min(*d.least, *shared);
}

// The largest magnitude in each column: numbers that are round-off relative to it share no digits and do not differ.
std::vector<double> scales(std::istream& table) {
  std::vector<double> all;
  for (std::string line; std::getline(table, line);) {
    const std::vector<std::string> cells = report::cells_of(line);
    if (cells.size() > all.size()) all.resize(cells.size(), 0);
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (const auto x = number(cells[k]); x && std::isfinite(*x)) all[k] = std::max(all[k], std::abs(*x));
  }
  table.clear(), table.seekg(0);
  return all;
}

Difference compare_tables(std::istream& a, std::istream& b) {
  Difference d;
  const std::vector<double> scale = scales(a);
  std::string line_a, line_b;
  std::vector<std::string> header;
  for (std::size_t row = 0;; ++row) {
    const bool more_a = bool(std::getline(a, line_a)), more_b = bool(std::getline(b, line_b));
    if (!more_a && !more_b) return d;
    if (row == 0) header = report::cells_of(line_a);
    if (more_a != more_b) {
      note(d, fmt::format("row {}", row), more_a ? "a row" : "no row", more_b ? "a row" : "no row");
      return d;
    }
    if (line_a == line_b) continue;
    const std::vector<std::string> x = report::cells_of(line_a), y = report::cells_of(line_b);
    for (std::size_t k = 0; k < std::max(x.size(), y.size()); ++k) {
      const std::string in_a = k < x.size() ? x[k] : "", in_b = k < y.size() ? y[k] : "";
      if (in_a == in_b) continue;
      const std::string column = k < header.size() ? header[k] : fmt::format("{}", k + 1);
      note(d,
           row == 0 ? fmt::format("the header, column {}", k + 1)
                    : fmt::format("row {} ({} = {}), column {}", row, header.empty() ? "" : header[0],
                                  x.empty() ? "" : x[0], column),
           in_a, in_b, k < scale.size() ? scale[k] : 0);
    }
  }
}

const std::set<std::string> always_differ = {
    "wall_time_s", "cpu_time_s", "cost_by_component", "made", "versions", "plugins",
    "scene",       "file",       "command",           "page", "cpu"};

void compare_json(const json& a, const json& b, const std::string& path, Difference& d) {
  if (a == b) return;
  if (a.is_object() && b.is_object()) {
    std::set<std::string> keys;
    for (const auto& [key, value] : a.items()) keys.insert(key);
    for (const auto& [key, value] : b.items()) keys.insert(key);
    for (const std::string& key : keys) {
      if (path.empty() && always_differ.contains(key)) continue;
      const std::string inner = path.empty() ? key : path + "." + key;
      compare_json(a.contains(key) ? a[key] : json(), b.contains(key) ? b[key] : json(), inner, d);
    }
  } else if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i) compare_json(a[i], b[i], fmt::format("{}[{}]", path, i), d);
  } else {
    note(d, path, a.dump(), b.dump());
  }
}

Difference compare_lines(std::istream& a, std::istream& b) {
  Difference d;
  std::string line_a, line_b;
  for (std::size_t row = 1;; ++row) {
    const bool more_a = bool(std::getline(a, line_a)), more_b = bool(std::getline(b, line_b));
    if (!more_a && !more_b) return d;
    if (more_a != more_b)
      return note(d, fmt::format("line {}", row), more_a ? "a line" : "no line", more_b ? "a line" : "no line"), d;
    if (line_a == line_b) continue;
    Difference of_line;
    compare_json(json::parse(line_a, nullptr, false), json::parse(line_b, nullptr, false), "", of_line);
    if (of_line.count > 0) note(d, fmt::format("line {}, {}", row, of_line.where), of_line.a, of_line.b);
  }
}

Difference compare_bytes(std::istream& a, std::istream& b) {
  Difference d;
  const std::string x((std::istreambuf_iterator<char>(a)), {}), y((std::istreambuf_iterator<char>(b)), {});
  const auto [in_x, in_y] = std::mismatch(x.begin(), x.end(), y.begin(), y.end());
  if (in_x == x.end() && in_y == y.end()) return d;
  note(d, fmt::format("byte {}", in_x - x.begin()), fmt::format("{} bytes", x.size()),
       fmt::format("{} bytes", y.size()));
  return d;
}

Difference compare_file(const fs::path& a, const fs::path& b) {
  std::ifstream in_a(a, std::ios::binary), in_b(b, std::ios::binary);
  const std::string ending = a.extension().string();
  if (ending == ".csv") return compare_tables(in_a, in_b);
  if (ending == ".ndjson") return compare_lines(in_a, in_b);
  if (ending == ".json") {
    Difference d;
    compare_json(json::parse(in_a, nullptr, false), json::parse(in_b, nullptr, false), "", d);
    return d;
  }
  return compare_bytes(in_a, in_b);
}

// A file of the command's own, not for a reader.
bool is_result(const fs::path& file) {
  const std::string name = file.filename().string();
  return !name.starts_with("checkpoint") && name != "cases.ndjson" && !name.ends_with(".tmp") &&
         file.extension() != ".html";
}

std::set<std::string> files(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& item : fs::directory_iterator(folder))
    if (item.is_regular_file() && is_result(item.path())) names.insert(item.path().filename().string());
  if (names.empty()) throw simulate::FolderRefused(fmt::format("{} holds no results", folder.string()));
  return names;
}

json head_of(const fs::path& folder) {
  for (const char* name : {"result.json", "study.json", "trade.json", "modes.json"}) {
    std::ifstream in(folder / name);
    if (json all = json::parse(in, nullptr, false); all.is_object()) return all;
  }
  return json::object();
}

json plugin_hashes(const json& head) {
  json hashes = json::object();
  if (head.contains("plugins"))
    for (const json& one : head["plugins"]) hashes[one.value("name", "")] = one.value("hash", "");
  return hashes;
}

// Differences in how they were made: lines "scene_hash: a, b".
json making(const json& a, const json& b) {
  json all = json::array();
  const auto add = [&](const std::string& what, const json& x, const json& y) {
    if (x != y) all.push_back({{"what", what}, {"a", x}, {"b", y}});
  };
  const auto at = [](const json& head, const char* path) {
    const json::json_pointer place(path);
    return head.contains(place) ? head.at(place) : json();
  };
  for (const auto& [what, path] :
       {std::pair("scene", "/scene_hash"), std::pair("--set", "/made/set"), std::pair("commit", "/made/program/commit"),
        std::pair("version", "/made/program/version"), std::pair("build type", "/made/program/build_type"),
        std::pair("instruction set of the program", "/made/program/instruction_set"),
        std::pair("instruction set of the machine", "/made/host/instruction_set"),
        std::pair("compiler", "/versions/compiler"), std::pair("eigen", "/versions/eigen")})
    add(what, at(a, path), at(b, path));
  const json x = plugin_hashes(a), y = plugin_hashes(b);
  std::set<std::string> names;
  for (const auto& [name, hash] : x.items()) names.insert(name);
  for (const auto& [name, hash] : y.items()) names.insert(name);
  for (const std::string& name : names) add("plugin " + name, x.value(name, "not loaded"), y.value(name, "not loaded"));
  return all;
}

std::string line_of(const Difference& d) {
  std::string text = fmt::format("{}: first at {}: {} and {}", d.file, d.where, d.a, d.b);
  if (d.digits) text += fmt::format(", {:.1f} digits agree", *d.digits);
  if (d.count > 1) text += fmt::format("; {} values differ", d.count);
  if (d.count > 1 && d.least) text += fmt::format(", the worst agrees in {:.1f} digits", *d.least);
  return text + "\n";
}

json json_of(const Difference& d) {
  json one = {{"file", d.file}, {"where", d.where}, {"a", d.a}, {"b", d.b}, {"count", d.count}};
  if (d.digits) one["digits"] = *d.digits;
  if (d.least) one["fewest_digits"] = *d.least;
  return one;
}

struct FolderDifferences {
  std::vector<Difference> differences;  // of files in both folders; tables first, which readers look at first
  json only = json::array();            // files of one folder
};

FolderDifferences differences_of(const fs::path& a, const fs::path& b) {
  FolderDifferences found;
  const std::set<std::string> in_a = files(a), in_b = files(b);
  for (const std::string& name : in_a) {
    if (!in_b.contains(name)) {
      found.only.push_back({{"file", name}, {"in", a.string()}});
      continue;
    }
    Difference d = compare_file(a / name, b / name);
    d.file = name;
    if (d.count > 0) found.differences.push_back(d);
  }
  for (const std::string& name : in_b)
    if (!in_a.contains(name)) found.only.push_back({{"file", name}, {"in", b.string()}});
  std::stable_partition(found.differences.begin(), found.differences.end(),
                        [](const Difference& d) { return d.file.ends_with(".csv"); });
  return found;
}

std::string text_of(const FolderDifferences& found, const json& made) {
  std::string text;
  for (const Difference& d : found.differences) text += line_of(d);
  for (const json& one : found.only)
    text += fmt::format("{}: only in {}\n", one["file"].get<std::string>(), one["in"].get<std::string>());
  const bool equal = text.empty();
  if (equal) text += "The results are equal.\n";
  for (const json& one : made)
    text += fmt::format("made with another {}: {} and {}\n", one["what"].get<std::string>(), one["a"].dump(),
                        one["b"].dump());
  if (!equal && made.empty()) text += "Both were made alike: the same scene, program and plugins.\n";
  text.pop_back();
  return text;
}

}  // namespace

Comparison compare(const fs::path& a, const fs::path& b) {
  for (const fs::path& folder : {a, b})
    if (!fs::is_directory(folder)) throw simulate::FolderRefused(fmt::format("{} is no folder", folder.string()));
  const FolderDifferences found = differences_of(a, b);
  const json made = making(head_of(a), head_of(b));
  const bool equal = found.differences.empty() && found.only.empty();
  json list = json::array();
  for (const Difference& d : found.differences) list.push_back(json_of(d));
  return {.equal = equal,
          .text = text_of(found, made),
          .json = json{{"equal", equal}, {"differences", list}, {"only", found.only}, {"made", made}}.dump(
              2, ' ', false, json::error_handler_t::replace)};  // damaged files may contain bytes that are no text
}

}  // namespace trammel::study
