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

// Of `trammel run` or `trammel static`: {"name", "result", "scene", "series": {"columns": [{"name", "unit", "meaning",
// "path", "data": f64}], "rows", "interval"}, "events", "animation", "missing": [sentences]}. A folder without
// result.json, of a run that was killed, is shown as far as it goes.
nlohmann::ordered_json run_data(const std::filesystem::path& folder, const Room& room);

// Of `trammel modes`: {"name", "result", "shapes": [{"mode", "bodies": [{"name", "at": [[x, y], ...], "re", "im"}]}]}.
nlohmann::ordered_json modes_data(const std::filesystem::path& folder);

}  // namespace trammel::report
