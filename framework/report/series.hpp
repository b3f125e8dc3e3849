// series.csv for a report. A long one is reduced: each interval of rows becomes two rows with the least and the largest
// value of every column, in the order in which they occur. So no extreme is lost, and a plot looks as with all rows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trammel::report {

struct Series {
  std::vector<std::string> names;            // "t" first
  std::vector<std::vector<double>> columns;  // values by column
  long long rows = 0;                        // in the file
  long long interval = 1;                    // rows that became two; 1: all rows are here
};

// At most `most_numbers` values, but up to 200 rows in any case. Throws std::runtime_error naming file and line for a
// row that holds anything but numbers. A last line that was cut off, as in a run that was killed, is skipped.
Series read_series(const std::filesystem::path& file, std::size_t most_numbers);

}  // namespace trammel::report
