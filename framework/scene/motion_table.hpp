// A law of time from a text table, wherever a scene takes one:
//
//     {"table": "quake.csv", "column": "a_x", "holds": "accelerations", "scale": 9.81, "beyond": "zero"}
//
// "table" is the path of a file relative to the file that names it. Columns are separated by commas, semicolons or
// blanks. Empty lines and lines that start with # are skipped. A first line that is not a row of numbers gives the
// names of the columns. "time" and "column" are such names or numbers from 1 (default 1 and 2). "holds" is "values"
// (default) or "accelerations"; "scale" multiplies them. "beyond" ("hold", "zero" or "repeat") defines the law before
// the first and after the last row, see tabulated_law.hpp, which also describes the interpolation. Without "beyond" the
// table must cover the whole run (simulate/start/law_checks.hpp).
#pragma once

#include <optional>
#include <string_view>

#include "scene/value.hpp"

namespace trammel::scene {

// The number in a cell of a table; none if the cell holds anything but a finite number and blanks.
std::optional<double> number_of_cell(std::string_view cell);

// Problems in the table are reported with its file and line.
std::optional<TimeFunction> read_motion_table(const Value& object, Problems& problems);

}  // namespace trammel::scene
