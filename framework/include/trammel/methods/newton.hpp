// Newton's iteration with kept factors: when to stop, when to factorise anew, when to give up.
//
// The factors of the first iterate serve as long as the increments shrink fast. With theta the ratio of two successive
// increments, the error left after the last one is about theta/(1 - theta) times it (Hairer, Wanner, Solving ODEs II,
// IV.8); the iteration ends when that is below `tolerance`, or when the increments are round-off and shrink no further.
// Where the first increment measures the step's own error, as from a prediction of the method's order, an error left of
// `share_of_first` of it is enough, too: more would not make the step any better.
//
//     newton.start(share_of_first);
//     while (newton.iterating()) {
//       residual...
//       if (newton.wants_factors()) factorise...
//       solve for the increment and apply it
//       newton.judge(increment relative to the unknowns' size, at round-off?)
//     }
//     return newton.outcome();
#pragma once

#include <trammel/outcome.hpp>

namespace trammel {

class Newton {
 public:
  double tolerance = 1e-11;  // of the error left, relative to the size of the unknowns
  int max_iterations = 12;   // before the step is rejected

  void start(double share_of_first = 0);
  bool iterating() const { return state_ == State::iterating; }
  bool converged() const { return state_ == State::converged; }
  bool wants_factors() const { return wants_factors_; }
  // Whether an increment of this size is one of a fast iteration that may go on, so that round-off need not be asked for.
  bool fast(double change) const {
    return iterations_ == 0 || (change < 0.5 * last_change_ && iterations_ + 1 < max_iterations);
  }
  // After an increment of relative size `change` was applied. `at_round_off`: a further one could not be more than
  // noise.
  void judge(double change, bool at_round_off);
  double rate() const { return rate_; }  // theta of the last two increments; 1 if there was one only
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
