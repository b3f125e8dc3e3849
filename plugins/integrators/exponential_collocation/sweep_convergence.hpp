// The convergence of the sweeps of a step, and the part of the prediction's error that they leave.
//
// The change by a sweep is r times the change by the sweep before; r is O(h) with dampers, O(h^2) with springs. It is
// observed in steps with two sweeps; if steps take one sweep, every twentieth step takes a second one to observe it.
// The remaining error, r^sweeps times the prediction's error, enters the next prediction. Extrapolating the polynomials
// amplifies it by up to 3000 (h / last h)^4 (measured on a damped mass for one to three sweeps: 940, 2900, 2300). A
// step after which errors would grow is rejected.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/archive.hpp>

namespace trammel::collocation {

class SweepConvergence {
 public:
  // Begins a step of size h, `longer` times the last one, whose polynomials predict it; longer = 0: constant
  // prediction. `rounding`: round-off of the changes by sweeps; changes below `unseen` do not matter.
  void begin(double h, double longer, double rounding, double unseen) {
    h_ = h, longer_ = longer, rounding_ = rounding, unseen_ = unseen;
    change_ = before_ = {};
  }
  // The change by a sweep, whole and along the rows onto which points are projected. The part across the rows may be
  // pure round-off (error_along_rows.hpp), which sweeps do not reduce.
  struct Change {
    double whole = std::numeric_limits<double>::infinity(), along_rows = whole;
  };
  // Records a sweep's change of values of this size.
  void swept(const Change& change, double size) { before_ = change_, change_ = change, size_ = size; }

  bool settled() const { return change_.along_rows <= no_change * size_ + 4 * rounding_; }
  bool known() const { return trusted_ > 0 && h_ <= longest_trusted * seen_h_; }

  double contraction() const {
    if (seen()) return std::min(change_.whole / before_.whole, change_.along_rows / before_.along_rows);
    const double by = seen_h_ > 0 ? h_ / seen_h_ : 0;
    return seen_ * std::max(by, by * by);
  }
  // Amplification of errors from step to step; must not exceed 1.
  double growth(int sweeps) const { return amplification * std::pow(longer_, 4) * std::pow(contraction(), sweeps); }
  bool diverges(int sweeps) const { return longer_ > 0 ? growth(sweeps) > 1 : contraction() > diverging; }
  // True if convergence is less than twice as fast as required, or if a sweep gains no digit.
  bool slow(int sweeps) const { return growth(sweeps) > std::pow(0.5, sweeps) || contraction() > one_digit; }

  // The step was accepted.
  void accept() {
    if (seen())
      seen_ = contraction(), seen_h_ = h_, trusted_ = steps_between_observations;
    else if (trusted_ > 0)
      --trusted_;
  }
  // Discards the observations.
  void distrust() { trusted_ = 0; }

  void archive(Archive& archive) {
    archive("contraction", seen_);
    archive("contraction_h", seen_h_);
    archive("contraction_trusted", trusted_);
  }

 private:
  // Relative to the values: a change by a sweep that is round-off, and a change that is large enough to observe r.
  static constexpr double no_change = 1e-12, measurable = 1e-10;
  static constexpr double amplification = 3000;    // of errors by extrapolation to a step of the same size
  static constexpr double longest_trusted = 1.25;  // step for which an observed r is used, in lengths of that step
  static constexpr double diverging = 0.5, one_digit = 0.1;  // r
  static constexpr int steps_between_observations = 20;

  // True if this step observed r: two sweeps, the first with a change well above round-off.
  bool seen() const {
    const double before = before_.along_rows;
    return std::isfinite(before) && before > measurable * size_ + 100 * (rounding_ + unseen_);
  }

  double h_ = 0, longer_ = 0, rounding_ = 0, unseen_ = 0, size_ = 0;
  Change change_, before_;
  double seen_ = 0, seen_h_ = 0;  // r, and the size of the step where it was observed
  int trusted_ = 0;               // number of steps until the next observation
};

}  // namespace trammel::collocation
