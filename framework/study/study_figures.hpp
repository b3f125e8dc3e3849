// Figures of a study's report, each of some columns of some cases over time.
//
//     "figures": [{"title": "Figure 2: HHT, e = 0", "observe": "theta",
//                  "cases": {"scene": "../hht.json", "parameters.e": 0}, "scale": "log", "time": "log"}]
//
// "observe": a column of series.csv or a list of columns. "cases": selects those with these values (null: a path that a
// case leaves unchanged), or with one of several sets of values in a list; without it all cases. "scale" of the column
// and "time": linear if not given.
#pragma once

#include <string>
#include <vector>

#include "scene/value.hpp"

namespace trammel::study {

struct StudyFigure {
  std::string title;
  std::vector<std::string> observe;
  std::vector<std::size_t> cases;
  bool log = false, log_time = false;
};

// `paths` and `values` are those of the cases (Study). Problems are reported.
std::vector<StudyFigure> read_figures(const scene::Value& figures, const std::vector<std::string>& paths,
                                      const std::vector<std::vector<std::string>>& values, scene::Problems& problems);

}  // namespace trammel::study
