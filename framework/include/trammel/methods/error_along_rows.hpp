// Selects the part of a local error that controls the step when the rows are satisfied at the end of each step.
//
// The whole error counts as long as it decreases with the step size. If it does not, it is round-off: near a change of
// rank, at an angle theta from it, rows that are satisfied to d leave the velocities across them uncertain by d /
// theta^2 and the accelerations by d / theta^3, and no step size would be small enough. This error is harmless, because
// steps end on the rows. From then on, only the part along the rows counts, until the whole error is small again.
#pragma once

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>
#include <trammel/system.hpp>

namespace trammel {

class ErrorAlongRows {
 public:
  enum class Part { whole, along_rows };

  // `estimate`, a double(Part), returns the norm of the error of the trial from `now` to `next`.
  template <class Estimate>
  double judge(const State& now, const State& next, Estimate&& estimate) {
    const double whole = estimate(Part::whole);
    rounding_ = whole > 1 && (rounding_ || !falls(now, next, whole));
    return rounding_ ? estimate(Part::along_rows) : whole;
  }
  // Removes the part of e_v across the rows at `at`: the change of least kinetic energy that gives G e_v = 0.
  void project(System& s, const State& at, Vec& e_v);
  // The same at the system's current point, with the existing factors of Factors::projection.
  void project(System& s, Vec& e_v);

  void forget() { rounding_ = false, trial_ = {}; }  // to be called where a motion begins
  void archive(Archive& archive) { archive("rounding", rounding_); }

 private:
  // True if the error decreased at least with second order since the last, longer trial from `now`, or if there was
  // none.
  bool falls(const State& now, const State& next, double error);

  struct Trial {
    double t = 0, h = 0, error = 0;
  } trial_;  // the last trial whose error was too large
  bool rounding_ = false;
  Vec zero_, no_force_, right_, change_, mu_;
};

}  // namespace trammel
