// animation.ndjson for a report: as many of its lines as fit, with coordinates as 16-bit numbers in the box that
// contains all points (a unit is 1/65535 of its longest side).
//
//     {"frames": n, "total": lines of the file, "stride": lines from one frame to the next, "dimension": 2 or 3,
//      "times": f64, "low": [x, y, z], "step": metres per unit,
//      "layouts": [{"first": frame, "bodies": [{"name", "points"}], "faces": [{"name", "points", "quads": u32}],
//                   "joints": [names], "balls": [names]}],               what the points of the frames from `first` on are
//      "points": u16, "values": u16 of faces, "low_value", "high_value",
//      "contacts": [names], "forces": [names],
//      "arrows": {"counts": u16 per frame, "data": f32}}    name (contacts, then forces), then place and force; of a
//                                                           force its first end, place, force
//
// with arrays as base64 texts of little-endian numbers.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace trammel::report {

// Returns null if the file does not exist. Throws std::runtime_error naming file and line if a line is not JSON, but
// skips a last line that was cut off.
nlohmann::ordered_json read_animation(const std::filesystem::path& file, std::size_t most_bytes);

}  // namespace trammel::report
