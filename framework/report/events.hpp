// events.csv for a report: the first lines as they are, and the number of each kind.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace trammel::report {

// {"columns": [...], "rows": [[t, kind, component, figure or null, ...], ...], "total": n, "kinds": {"impact": n, ...}};
// columns without any figure are left out. Without the file there are no events.
nlohmann::ordered_json read_events(const std::filesystem::path& file, std::size_t most_rows);

}  // namespace trammel::report
