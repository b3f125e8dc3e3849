// Full turns in space. A pose determines an angle only up to whole turns. Forces and joints that depend on such an
// angle count the turns from one accepted state to the next; planar bodies count them in their own coordinate.
#pragma once

#include <cmath>
#include <numbers>

#include <trammel/archive.hpp>
#include <trammel/marker.hpp>

namespace trammel {

// Continues an angle [rad] that is known up to whole turns from its last value. The result is smooth if the angle
// changes by less than half a turn between two values.
class CountedAngle {
 public:
  explicit CountedAngle(double first = 0) : last_(first) {}
  // `angle` plus the number of whole turns that brings it nearest to the last value.
  double near_last(double angle) const {
    constexpr double turn = 2 * std::numbers::pi;
    return angle + turn * std::round((last_ - angle) / turn);
  }
  void follow(double angle) { last_ = near_last(angle); }
  void archive(Archive& a) { a("angle", last_); }

 private:
  double last_;
};

// Ability of forces and joints: `follow` is called with every accepted state, starting with the first (with the first
// two markers if there are more). Each instance keeps its own count, which is part of a checkpoint.
class CountsTurns {
 public:
  virtual ~CountsTurns();
  // May throw OutsideDomain if the angle can be counted no further; the run then ends.
  virtual void follow(const Motion& A, const Motion& B) = 0;
  virtual void archive(Archive&) = 0;
};

}  // namespace trammel
