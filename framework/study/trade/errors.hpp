// Errors of observables against a reference, at the times of the records.
//
// Each observable is divided by its scale, the largest |x - x(start)| of the reference, or |x| if x varies by less than
// a millionth of that, and at least 1e-8 of the largest scale, so that the round-off of 0 does not count as an error.
// Records within a hundredth of their interval from an impact do not count: a velocity jumps there, and a record before
// the jump in one run and after it in the other shows no error. Multipliers (contact forces, reactions, accelerations),
// which a method finds with fewer digits than positions, have a maximum of their own.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "scene/value.hpp"
#include "study/cases/case_run.hpp"

namespace trammel::study {

// The error of a run that did not reach its end.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Error {
  double max = 0, rms = 0;  // of positions, velocities, energies
  double multipliers = 0;   // max
  std::string worst;        // observable at which max is
  double t = 0;             // [s] time of max
};

class Measure {
 public:
  // `observed`: names of columns that count; empty: all. `scene` says what each observes.
  Measure(const CaseResult& reference, const std::vector<std::string>& observed, const scene::Scene& scene);

  // Over the records until `until` [s]; infinite if the run did not reach that time.
  Error error(const Series& series, const Series& reference, double until) const;
  Error error(const Series& series, double until) const { return error(series, reference_.series, until); }
  // The last record before which two runs differ by no more than `limit` at all records; the end if they never do.
  double agree_until(const Series& a, const Series& b, double limit) const;

  const CaseResult& reference() const { return reference_; }
  double end() const { return reference_.series.t.back(); }
  double scale(std::size_t column) const { return scales_[column]; }

 private:
  double off(const Series& a, const Series& b, std::size_t row, std::size_t column) const;
  CaseResult reference_;
  std::vector<std::size_t> columns_, multipliers_;
  std::vector<double> scales_;
  std::vector<bool> at_impact_;  // by row
};

}  // namespace trammel::study
