// Which part of a local error counts where rows hold at the end of each step.
//
// The whole while it falls as steps are shortened. If not, it is round-off: near a change of rank, an angle theta from it, rows that hold
// to d leave velocities across them uncertain by d / theta^2 and accelerations by d / theta^3, and steps small enough for that would come
// to no end. It does no harm, as steps end on the rows. From there to where the whole is small again what is along the rows counts.
#pragma once

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>
#include <trammel/system.hpp>

namespace trammel {

class ErrorAlongRows {
 public:
  enum class Part { whole, along_rows };

  // `estimate`, a double(Part), tells the norm of the error of the trial from `now` to `next`.
  template <class Estimate>
  double judge(const State& now, const State& next, Estimate&& estimate) {
    const double whole = estimate(Part::whole);
    rounding_ = whole > 1 && (rounding_ || !falls(now, next, whole));
    return rounding_ ? estimate(Part::along_rows) : whole;
  }
  // e_v without its part across the rows at `at`: the change of least kinetic energy to G e_v = 0.
  void project(System& s, const State& at, Vec& e_v);
  // Where the system stands, by the factors of Factors::projection as they are.
  void project(System& s, Vec& e_v);

  void forget() { rounding_ = false, trial_ = {}; }  // where a motion begins
  void archive(Archive& archive) { archive("rounding", rounding_); }

 private:
  // At least as of second order since the last trial from `now`, which was longer, if there was one.
  bool falls(const State& now, const State& next, double error);

  struct Trial {
    double t = 0, h = 0, error = 0;
  } trial_;  // the last whose error was too large
  bool rounding_ = false;
  Vec zero_, no_force_, right_, change_, mu_;
};

}  // namespace trammel
