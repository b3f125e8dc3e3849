// The cubic polynomial through values and slopes at both ends of an interval (Hermite).
#pragma once

#include <optional>

namespace trammel::numerics {

struct ValueAndSlope {
  double f, slope;
};

struct Cubic {
  double low, high;
  ValueAndSlope at_low, at_high;

  double length() const { return high - low; }
  double value(double x) const;  // at the part x of the interval
  struct Minimum {
    double at, f;
  };
  std::optional<Minimum> minimum() const;  // inside the interval
  // The distance of bodies that pass each other is convex, and so is the load of a joint's bearings, a sum of lengths.
  // Such a function is at least as large as its tangents at the ends, which meet where it may have a kink that the
  // cubic rounds off. Where they meet, if this is below 0.
  std::optional<double> kink_below_zero() const;
  // Where a cubic that is positive at `low` and negative at `high` crosses 0.
  double crossing() const;

 private:
  // f = f_low + h x (slope_low + x (curve + x twist))
  double rise() const { return (at_high.f - at_low.f) / length(); }
  double curve() const { return 3 * rise() - 2 * at_low.slope - at_high.slope; }
  double twist() const { return at_low.slope + at_high.slope - 2 * rise(); }
};

}  // namespace trammel::numerics
