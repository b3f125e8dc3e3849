// Turns in space beyond half of one: a pose tells an angle but for whole turns. They are counted on from state to state, as planar
// bodies' own angles count them, by forces and joints that depend on such an angle.
#pragma once

#include <cmath>
#include <numbers>

#include <trammel/archive.hpp>
#include <trammel/marker.hpp>

namespace trammel {

// An angle [rad] known but for whole turns, counted on from where it was last: smooth as long as it is less than half a turn away.
class CountedAngle {
 public:
  explicit CountedAngle(double first = 0) : last_(first) {}
  // `angle` and as many whole turns as take it nearest to the last one.
  double near_last(double angle) const {
    constexpr double turn = 2 * std::numbers::pi;
    return angle + turn * std::round((last_ - angle) / turn);
  }
  void follow(double angle) { last_ = near_last(angle); }
  void archive(Archive& a) { a("angle", last_); }

 private:
  double last_;
};

// Ability of forces and joints: to be told the states that became the solution, from the first one on; of more than two markers A and
// B. Each instance counts for itself, and its count is part of a checkpoint.
class CountsTurns {
 public:
  virtual ~CountsTurns();
  // May throw OutsideDomain where what it depends on can be counted no further: the run then ends.
  virtual void follow(const Motion& A, const Motion& B) = 0;
  virtual void archive(Archive&) = 0;
};

}  // namespace trammel
