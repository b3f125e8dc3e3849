// Scalars of a run: "reduce": {"swing": {"observe": "theta", "as": "max"}}
//
//     final, initial        the last record, the first
//     max, min, max_abs     over the records, and the value of one record: no interpolation
//     mean, rms             over the time, by the trapezoidal rule; rms of the difference to "reference", if given: a
//     number,
//                           or {"file": "measured.csv", "column": "theta"}, linear between its rows
//     first_crossing        [s] the first time at which "level" is crossed in "direction" (up, down or any), linear
//                           between records; NaN: never
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scene/value.hpp"
#include "study/cases/series.hpp"

namespace trammel::study {

// A value that a run does not have.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Reference {
  double constant = 0;
  std::vector<double> t, x;  // if not empty
  double at(double time) const;
};

struct Reduction {
  enum class As { final, initial, max, min, max_abs, mean, rms, first_crossing };
  enum class Direction { up, down, any };
  std::string name, observe;
  As as = As::final;
  double level = 0;
  Direction direction = Direction::any;
  Reference reference;

  // NaN: the series has no such value.
  double of(const Series& series) const;
};

// Files are relative to that of the study. Problems are reported.
std::vector<Reduction> read_reductions(const scene::Value& reduce, scene::Problems& problems);

}  // namespace trammel::study
