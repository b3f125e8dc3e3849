// Whether the sweeps of a step converge, and what they leave of the guess they begin with.
//
// A sweep shrinks what the sweep before it changed by a factor r: with dampers like h, with springs like h^2. It is seen where a step
// takes two sweeps; with one, every twentieth step takes a second to see it. What is left, r^sweeps of the guess's error, goes into
// the next guess, polynomials carried a step ahead, which multiply it by up to 3000 (h / last h)^4 (measured on a damped mass
// for one to three sweeps: 940, 2900, 2300): a step after which errors would grow is refused.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/archive.hpp>

namespace trammel::collocation {

class SweepConvergence {
 public:
  // A step of length h, `longer` times the last one, whose polynomials are its guess; 0: the guess is constant. What sweeps change
  // has this `rounding`; no more than `unseen` of it does not matter.
  void begin(double h, double longer, double rounding, double unseen) {
    h_ = h, longer_ = longer, rounding_ = rounding, unseen_ = unseen;
    change_ = before_ = {};
  }
  // By how much a sweep changed the whole, and what of it is along rows that points are put onto. Across them it may be nothing but
  // round-off (error_along_rows.hpp), which no sweep makes smaller.
  struct Change {
    double whole = std::numeric_limits<double>::infinity(), along_rows = whole;
  };
  // A sweep has changed what is of this size by so much.
  void swept(const Change& change, double size) { before_ = change_, change_ = change, size_ = size; }

  bool settled() const { return change_.along_rows <= 1e-12 * size_ + 4 * rounding_; }
  bool known() const { return trusted_ > 0 && h_ <= 1.25 * seen_h_; }

  double contraction() const {
    if (seen()) return std::min(change_.whole / before_.whole, change_.along_rows / before_.along_rows);
    const double by = seen_h_ > 0 ? h_ / seen_h_ : 0;
    return seen_ * std::max(by, by * by);
  }
  // Of errors from step to step; at most 1.
  double growth(int sweeps) const { return 3000 * std::pow(longer_, 4) * std::pow(contraction(), sweeps); }
  bool diverges(int sweeps) const { return longer_ > 0 ? growth(sweeps) > 1 : contraction() > 0.5; }
  // Not twice as fast as it must be, or a sweep wins no digit.
  bool slow(int sweeps) const { return growth(sweeps) > std::pow(0.5, sweeps) || contraction() > 0.1; }

  // The step has become the solution.
  void accept() {
    constexpr int serves = 20;
    if (seen())
      seen_ = contraction(), seen_h_ = h_, trusted_ = serves;
    else if (trusted_ > 0)
      --trusted_;
  }
  // What was seen so far serves no more.
  void distrust() { trusted_ = 0; }

  void archive(Archive& archive) {
    archive("contraction", seen_);
    archive("contraction_h", seen_h_);
    archive("contraction_trusted", trusted_);
  }

 private:
  bool seen() const {
    const double before = before_.along_rows;
    return std::isfinite(before) && before > 1e-10 * size_ + 100 * (rounding_ + unseen_);
  }

  double h_ = 0, longer_ = 0, rounding_ = 0, unseen_ = 0, size_ = 0;
  Change change_, before_;
  double seen_ = 0, seen_h_ = 0;  // r, and the length of the step that showed it
  int trusted_ = 0;               // for so many steps
};

}  // namespace trammel::collocation
