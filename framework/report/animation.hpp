// animation.ndjson for a report: some of its lines, as many as fit, with places as 16-bit numbers in the box that
// contains them all (a step is 1/65535 of its longest side).
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

// Null without the file. Throws std::runtime_error naming file and line for a line that is no JSON; a last one that was
// cut off is left out.
nlohmann::ordered_json read_animation(const std::filesystem::path& file, std::size_t most_bytes);

}  // namespace trammel::report
