// The data of a report on one results folder.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace trammel::report {

// Room for a folder's data [bytes], before base64.
struct Room {
  std::size_t series = 900'000, animation = 1'500'000;
  std::size_t events = 3000;  // rows

  Room shared_by(std::size_t runs) const { return {series / runs, animation / runs, events / runs + 1}; }
};

// For a folder of `trammel run` or `trammel static`: {"name", "result", "scene", "series": {"columns": [{"name", "unit", "meaning",
// "path", "data": f64}], "rows", "interval"}, "events", "animation", "missing": [sentences]}. Of a
// run that was killed, whose folder has no result.json, the existing files are shown.
nlohmann::ordered_json run_data(const std::filesystem::path& folder, const Room& room);

// For a folder of `trammel modes`: {"name", "result", "shapes": [{"mode", "bodies": [{"name", "at": [[x, y], ...], "re", "im"}]}]}.
nlohmann::ordered_json modes_data(const std::filesystem::path& folder);

}  // namespace trammel::report
