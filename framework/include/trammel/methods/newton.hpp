// Control of a modified Newton iteration: when to stop, when to factorise again, when to give up.
//
// The factors of the first iterate are reused as long as the increments decrease fast. With theta the ratio of two
// successive increments, the remaining error is about theta/(1 - theta) times the last increment (Hairer, Wanner,
// Solving ODEs II, IV.8). The iteration ends when this is below `tolerance`, or when the increments have reached
// round-off and decrease no further. If the first increment measures the step's own error, as it does after a
// prediction of the method's order, a remaining error of `share_of_first` times that increment is sufficient, too: more
// iterations do not improve the step.
//
//     newton.start(share_of_first);
//     while (newton.iterating()) {
//       residual...
//       if (newton.wants_factors()) factorise...
//       solve for the increment and apply it
//       newton.judge(increment relative to the size of the unknowns, whether it is at round-off)
//     }
//     return newton.outcome();
#pragma once

#include <trammel/outcome.hpp>

namespace trammel {

class Newton {
 public:
  double tolerance = 1e-11;  // of the remaining error, relative to the size of the unknowns
  int max_iterations = 12;   // before the step is rejected

  void start(double share_of_first = 0);
  bool iterating() const { return state_ == State::iterating; }
  bool converged() const { return state_ == State::converged; }
  bool wants_factors() const { return wants_factors_; }
  // True if the iteration converges fast with an increment of this size and may continue: the caller need not test for
  // round-off.
  bool fast(double change) const {
    return iterations_ == 0 || (change < 0.5 * last_change_ && iterations_ + 1 < max_iterations);
  }
  // Call it after an increment of relative size `change` was applied. `at_round_off`: a further increment would be
  // round-off only.
  void judge(double change, bool at_round_off);
  bool first() const { return iterations_ == 0; }
  // Continues with new factors after the iteration has converged, because the caller doubts the factors of an earlier
  // iterate.
  void renew() { state_ = State::iterating, wants_factors_ = true; }
  void confirm() { state_ = State::converged; }
  double rate() const { return rate_; }  // theta of the last two increments; 1 after a single increment
  void fail(const char* reason);
  Outcome outcome() const { return converged() ? Outcome::accept() : Outcome::reject(reason_); }

 private:
  enum class State { iterating, converged, failed };
  State state_ = State::failed;
  bool wants_factors_ = true;
  int iterations_ = 0;
  double last_change_ = 0, rate_ = 1, share_of_first_ = 0, enough_ = 0;
  const char* reason_ = "Newton's iteration was not run";
};

}  // namespace trammel
