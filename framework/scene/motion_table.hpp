// A law of time from a text table, wherever a scene takes one:
//
//     {"table": "quake.csv", "column": "a_x", "holds": "accelerations", "scale": 9.81, "beyond": "zero"}
//
// "table" is a file beside the one that names it; columns are separated by commas, semicolons or blanks; lines that start
// with # and empty lines do not count; a first line that is no row of numbers names the columns. "time" and "column" are such
// names or numbers from 1 (default 1 and 2). "holds": "values" (default) or "accelerations"; "scale" multiplies them.
// tabulated_law.hpp says how rows are joined, and what "beyond" makes of times before the first row and after the last:
// "hold", "zero" or "repeat". Without it the table must hold the whole run (simulate/start/smooth_laws.hpp).
#pragma once

#include "scene/value.hpp"

namespace trammel::scene {

// Problems of the table name its file and line.
std::optional<TimeFunction> read_motion_table(const Value& object, Problems& problems);

}  // namespace trammel::scene
