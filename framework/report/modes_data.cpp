// What a report shows of a folder of `trammel modes`: the outlines of bodies and how each mode moves them.
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/csv_line.hpp"
#include "report/json_file.hpp"
#include "report/run_data.hpp"

namespace trammel::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Rows "mode,body:point,x,y,x_re,y_re,x_im,y_im" of outlines; those of markers, "body.marker", are left out.
class Shapes {
 public:
  void add(const std::vector<std::string>& cells) {
    const auto colon = cells.at(1).rfind(':');
    if (colon == std::string::npos) return;
    const int mode = std::atoi(cells[0].c_str());
    const std::string body = cells[1].substr(0, colon);
    if (shapes_.empty() || shapes_.back()["mode"] != mode)
      shapes_.push_back({{"mode", mode}, {"bodies", Json::array()}});
    Json& bodies = shapes_.back()["bodies"];
    if (bodies.empty() || bodies.back()["name"] != body)
      bodies.push_back({{"name", body}, {"at", Json::array()}, {"re", Json::array()}, {"im", Json::array()}});
    const std::size_t dimension = (cells.size() - 2) / 3;
    const char* parts[] = {"at", "re", "im"};
    for (std::size_t p = 0; p < 3; ++p) {
      Json point = Json::array();
      for (std::size_t i = 0; i < dimension; ++i) point.push_back(short_number(cells[2 + p * dimension + i]));
      bodies.back()[parts[p]].push_back(std::move(point));
    }
  }
  Json json() { return std::move(shapes_); }

 private:
  // Five digits suffice for a picture.
  static double short_number(const std::string& text) {
    return std::strtod(fmt::format("{:.5g}", std::strtod(text.c_str(), nullptr)).c_str(), nullptr);
  }
  Json shapes_ = Json::array();
};

}  // namespace

Json modes_data(const fs::path& folder) {
  Json data = {{"name", fs::absolute(folder).lexically_normal().filename().string()},
               {"result", json_file(folder / "modes.json")}};
  std::ifstream in(folder / "shapes.csv");
  std::string line;
  std::getline(in, line);
  const std::size_t columns = cells_of(line).size();
  Shapes shapes;
  for (long long number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != columns)
      throw std::runtime_error(
          fmt::format("{}:{}: expected {} columns", (folder / "shapes.csv").string(), number, columns));
    shapes.add(cells);
  }
  data["shapes"] = shapes.json();
  return data;
}

}  // namespace trammel::report
