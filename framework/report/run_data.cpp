#include "report/run_data.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/animation.hpp"
#include "report/base64.hpp"
#include "report/events.hpp"
#include "report/json_file.hpp"
#include "report/series.hpp"

namespace trammel::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t longest_scene = 60'000;  // [bytes] shown whole

// Unit, meaning and path of a column, as result.json has them; older results have none.
Json column_of(const std::string& name, const Json& result) {
  Json column = {{"name", name}, {"unit", ""}, {"meaning", ""}, {"path", ""}};
  if (const Json* known = find(result, {"columns", "series"}))
    for (const Json& one : *known)
      if (one.value("name", "") == name) column.update(one);
  return column;
}

Json series_data(const fs::path& file, const Json& result, std::size_t most_bytes) {
  const Series series = read_series(file, most_bytes / sizeof(double));
  Json columns = Json::array();
  for (std::size_t c = 0; c < series.names.size(); ++c) {
    Json column = column_of(series.names[c], result);
    column["data"] = base64_of(series.columns[c]);
    columns.push_back(std::move(column));
  }
  return {{"columns", columns}, {"rows", series.rows}, {"interval", series.interval}};
}

std::string scene_text(const fs::path& file, Json& missing) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.size() <= longest_scene) return text;
  missing.push_back(fmt::format("The scene is too long to be shown here ({} bytes): scene.resolved.json", text.size()));
  return "";
}

}  // namespace

Json run_data(const fs::path& folder, const Room& room) {
  Json missing = Json::array(), result = Json::object();
  if (std::error_code error; fs::exists(folder / "result.json", error))
    result = json_file(folder / "result.json");
  else
    missing.push_back("There is no result.json: the run was killed before its end. What it had recorded is shown.");
  Json data = {{"name", fs::absolute(folder).lexically_normal().filename().string()}};
  if (data["name"] == "") data["name"] = fs::absolute(folder).parent_path().filename().string();
  data["series"] = series_data(folder / "series.csv", result, room.series);
  data["events"] = read_events(folder / "events.csv", room.events);
  data["animation"] = read_animation(folder / "animation.ndjson", room.animation);
  data["scene"] = scene_text(folder / "scene.resolved.json", missing);
  result.erase("columns");
  data["result"] = std::move(result);
  data["missing"] = std::move(missing);
  return data;
}

}  // namespace trammel::report
